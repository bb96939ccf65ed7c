// Inputs at which shaders fail, mixed with ordinary ones.
#pragma once

#include <cstdint>

#include "lab/sanitize/input_space.hpp"

namespace gobo::sanitize {

/// `count` points within the domains of what the stage reads, as floats hold them; uniforms change from point
/// to point. Half of the points have inputs that stand in a relation on which models have their edges:
/// vectors that are equal, aligned, opposed or nearly so, or at an exact cosine; numbers that are equal or
/// neighbours. Fragments lie in quads. The same seed gives the same points.
[[nodiscard]] PointSet hard_points(const InputSpace& space, std::size_t count, std::uint64_t seed);

}  // namespace gobo::sanitize
