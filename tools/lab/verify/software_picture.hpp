// A permutation drawn without a renderer: its stages evaluated in fp32, between them the rasteriser.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lab/render/render.hpp"
#include "validate/validate.hpp"
#include "lab/verify/link.hpp"
#include "lab/verify/render_feed.hpp"

namespace gobo::verify {

/// Both stages, ready to be evaluated, and what joins them.
struct SoftwareProgram {
    evaluate::Program vertex;
    evaluate::Program fragment;
    Link link;
    std::string color;  ///< the output at location 0; empty where there is none
};

/// Errors of decode(), and a varying that the vertex stage does not write.
[[nodiscard]] Result<SoftwareProgram> software_program(const SpirvModule& vertex,
                                                       const SpirvModule& fragment);

/// One object, rasterised, ready to be shaded.
struct SoftwareObject {
    evaluate::Invocations vertices;  ///< of the vertex stage
    evaluate::Invocations uniforms;  ///< of the fragment stage, without its inputs
    std::vector<std::uint32_t> indices;
    std::vector<glm::dvec4> positions;  ///< gl_Position of each vertex
    std::vector<Fragment> fragments;
    int width = 0;
    int height = 0;
};

/// Evaluates the vertex stage for one object and rasterises it, without the faces that it culls. `values` are
/// the family's, the object's own come after them; `view` is the camera's part, the model matrix is the
/// object's. Samplers that `images` names ask those, others hold the colour that `values` say.
[[nodiscard]] Result<SoftwareObject> rasterise_object(const SoftwareProgram& program,
                                                      const Interface& interface, const Object& object,
                                                      const std::vector<RenderValue>& values,
                                                      ViewedObject view, const evaluate::Images& images = {});

/// The same for every object of a picture. `values` and `view` as of render_permutation().
[[nodiscard]] Result<std::vector<SoftwareObject>> rasterise_objects(
    const SoftwareProgram& program, const Interface& interface, const std::vector<Object>& objects,
    const std::vector<RenderValue>& values, const View& view, const evaluate::Images& images = {});

/// The object with only those of its fragments for whose pixel `is_wanted(x, y)` says so, and the vertices of
/// their triangles.
[[nodiscard]] SoftwareObject part_of(const SoftwareProgram& program, const SoftwareObject& object,
                                     const std::function<bool(int, int)>& is_wanted);

}  // namespace gobo::verify
