// An object as the renderer is given it, rasterised for evaluation: its attributes and uniforms as a stage's
// inputs, and the pixels that its triangles cover.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lab/raster/pipeline.hpp"
#include "lab/raster/rasterise.hpp"
#include "lab/render/render.hpp"

namespace gobo::raster {

/// The family's values with one colour, the same everywhere, for each sampler: filtering differs between
/// renderers by more than arithmetic does, and is not what is tested. A colour or depth that the family gives
/// itself stays.
[[nodiscard]] std::vector<RenderValue> with_plain_textures(const Interface& interface,
                                                           std::vector<RenderValue> values);

/// Whose clip space and window a vertex stage writes positions for.
enum class ClipSpace { opengl, vulkan };

/// One object, ready to be shaded once it has positions and fragments.
struct RasterObject {
    evaluate::Invocations vertices;  ///< of the vertex stage
    evaluate::Invocations uniforms;  ///< of the fragment stage, without its inputs
    std::vector<std::uint32_t> indices;
    std::vector<glm::dvec4> positions;  ///< gl_Position of each vertex, in OpenGL's clip space
    std::vector<Fragment> fragments;
    int width = 0;
    int height = 0;
    ClipSpace clip_space = ClipSpace::opengl;  ///< Vulkan's window has its first row above

    /// The corners' weights on a triangle.
    [[nodiscard]] Interpolator interpolator(std::uint32_t triangle) const;
};

/// An object's inputs, uniforms and textures for both stages, as make_draw_list() sets them; neither
/// positions nor fragments. `values` are all that the object has; `view` holds its model matrix. Samplers
/// that `images` names ask those, others hold the colour that `values` say.
[[nodiscard]] Result<RasterObject> object_inputs(const Pipeline& pipeline, const Interface& interface,
                                                 const Mesh& mesh, const std::vector<RenderValue>& values,
                                                 const ViewedObject& view,
                                                 const evaluate::Images& images = {});

/// Evaluates the vertex stage for one object and rasterises it, without the faces that it culls. `values` are
/// the family's, the object's own come after them; `view` is the camera's part, with a projection to
/// `clip_space`, the model matrix is the object's.
[[nodiscard]] Result<RasterObject> rasterise_object(const Pipeline& pipeline, const Interface& interface,
                                                    const Object& object,
                                                    const std::vector<RenderValue>& values, ViewedObject view,
                                                    const evaluate::Images& images = {},
                                                    ClipSpace clip_space = ClipSpace::opengl);

/// The same for every object of a picture. `values` and `view` as of render_permutation().
[[nodiscard]] Result<std::vector<RasterObject>> rasterise_objects(
    const Pipeline& pipeline, const Interface& interface, const std::vector<Object>& objects,
    const std::vector<RenderValue>& values, const View& view, const evaluate::Images& images = {},
    ClipSpace clip_space = ClipSpace::opengl);

/// Leaves only the triangles that have fragments, and their vertices; returns what those were numbered
/// before. The vertex stage's inputs stay as they are.
std::vector<std::uint32_t> drop_unseen_triangles(RasterObject& object);

/// The object with only those of its fragments for whose pixel `is_wanted(x, y)` says so, and the vertices of
/// their triangles.
[[nodiscard]] RasterObject part_of(const Pipeline& pipeline, const RasterObject& object,
                                   const std::function<bool(int, int)>& is_wanted);

}  // namespace gobo::raster
