// Hands a stage what the renderer hands to OpenGL: an object's attributes and uniforms, and its textures.
#pragma once

#include <vector>

#include "lab/evaluate/evaluate.hpp"
#include "lab/render/draw_list.hpp"

namespace gobo::verify {

/// The family's values with one colour, the same everywhere, for each sampler: filtering differs between
/// renderers by more than arithmetic does, and is not what is tested. A colour or depth that the family gives
/// itself stays.
[[nodiscard]] std::vector<RenderValue> with_plain_textures(const Interface& interface,
                                                           std::vector<RenderValue> values);

/// The uniforms and textures of one object for a stage, as make_draw_list() sets them; no inputs yet.
[[nodiscard]] Result<evaluate::Invocations> uniforms_of(const evaluate::Program& program,
                                                        const Interface& interface,
                                                        const std::vector<RenderValue>& values,
                                                        const ViewedObject& view);

/// One invocation of the vertex stage for each vertex of the mesh.
void add_attributes(const evaluate::Program& program, const Mesh& mesh,
                    const std::vector<RenderValue>& values, evaluate::Invocations& invocations);

}  // namespace gobo::verify
