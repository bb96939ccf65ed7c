// Inputs at which shaders fail, mixed with ordinary ones, and steps from one to another.
#pragma once

#include "lab/sanitize/input_space.hpp"

namespace gobo::sanitize {

/// `count` points within the domains of what the stage reads, as floats hold them; uniforms change from point
/// to point. Half of the points have inputs that stand in a relation on which models have their edges:
/// vectors that are equal, aligned, opposed or nearly so, or at an exact cosine; numbers that are equal or
/// neighbours. Fragments lie in quads. The same seed gives the same points.
[[nodiscard]] PointSet hard_points(const InputSpace& space, std::size_t count, std::uint64_t seed);

/// Changes that number of the point, or all of its field, within the domain: by a few roundings, by any power
/// of two, to a hard number, or to some other number of the point.
void change(const InputSpace& space, std::span<double> point, std::size_t number, Random& random);

/// The same so many times, each time to any of its numbers.
void change_any(const InputSpace& space, std::span<double> point, std::size_t times, Random& random);

}  // namespace gobo::sanitize
