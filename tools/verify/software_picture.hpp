// A permutation drawn without a renderer: its stages evaluated in fp32, between them the rasteriser.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/render.hpp"
#include "validate/validated.hpp"
#include "verify/link.hpp"
#include "verify/render_feed.hpp"

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

/// What the fragment stage made of a fragment.
struct Shaded {
    std::array<double, 4> color = {0, 0, 0, 1};
    double depth = 0;
    bool is_discarded = false;
};

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

/// The fragment stage's inputs and uniforms, one invocation for each fragment of the object, interpolated
/// from the vertex stage's outputs in fp64.
[[nodiscard]] Result<evaluate::Invocations> exact_fragment_inputs(const SoftwareProgram& program,
                                                                  const SoftwareObject& object);

/// The operations executed, by kind: by all vertices together, and by all fragments.
struct Work {
    evaluate::Counts vertices{};
    evaluate::Counts fragments{};
};

/// Shades every fragment of the object, both stages in arithmetic of T: float or double. Adds to `work`
/// unless it is null.
template <class T>
[[nodiscard]] Result<std::vector<Shaded>> shade_in(const SoftwareProgram& program,
                                                   const SoftwareObject& object, Work* work = nullptr);

/// Shades every fragment of the object. `nudge` moves each attribute and each varying at random by up to that
/// much of the largest component of its vector, to see what hangs on a rounding; coverage stays. 0: none.
/// `operations`, where given, grows by what the fragment stage executes.
[[nodiscard]] Result<std::vector<Shaded>> shade(const SoftwareProgram& program, const SoftwareObject& object,
                                                double nudge, std::uint64_t seed,
                                                evaluate::Counts* operations = nullptr);

}  // namespace gobo::verify
