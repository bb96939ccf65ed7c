// The fragments of a rasterised object shaded: both stages evaluated, with inputs as they are or moved a
// little.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lab/verify/software_picture.hpp"

namespace gobo::verify {

/// What the fragment stage made of a fragment.
struct Shaded {
    std::array<double, 4> color = {0, 0, 0, 1};
    double depth = 0;
    bool is_discarded = false;
};

/// Where the fragment stage runs for the object's fragments: places_of(), in quads where the stage wants
/// them.
[[nodiscard]] std::vector<FragmentPlace> shading_places(const SoftwareProgram& program,
                                                        const SoftwareObject& object);

/// The fragment stage's inputs and uniforms, one invocation for each place, interpolated from the vertex
/// stage's outputs.
[[nodiscard]] evaluate::Invocations fragment_inputs(const SoftwareProgram& program,
                                                    const SoftwareObject& object,
                                                    const std::vector<FragmentPlace>& places,
                                                    const evaluate::Outputs& outputs);

/// The fragment stage in fp32 at the inputs of the shading_places(). `operations`, where given, grows by what
/// it executes.
[[nodiscard]] Result<std::vector<Shaded>> shade_fragments(const SoftwareProgram& program,
                                                          const SoftwareObject& object,
                                                          const evaluate::Invocations& inputs,
                                                          evaluate::Counts* operations = nullptr);

/// fragment_inputs() of the fragments alone, never in quads, and with the vertex stage in fp64.
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

/// How attributes and varyings are moved, to see what hangs on a rounding: each component at random by up to
/// `by` of the largest component of its vector. Coverage stays.
struct Nudge {
    double by = 0;
    std::uint64_t seed = 0;
};

/// Shades every fragment of the object, nudged.
[[nodiscard]] Result<std::vector<Shaded>> shade(const SoftwareProgram& program, const SoftwareObject& object,
                                                const Nudge& nudge = {},
                                                evaluate::Counts* operations = nullptr);

}  // namespace gobo::verify
