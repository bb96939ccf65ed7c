// Inputs at which shaders fail, mixed with ordinary ones, and steps from one to another.
#pragma once

#include "lab/sanitize/input_space.hpp"

namespace gobo::sanitize {

/// `count` points within the domains of what the stage reads, as floats hold them; uniforms change from point
/// to point. Half of the points have inputs that stand in a relation on which models have their edges:
/// vectors that are equal, aligned, opposed or nearly so, or at an exact cosine; numbers that are equal or
/// neighbours. Fragments lie in quads. The same seed gives the same points.
[[nodiscard]] PointSet hard_points(const InputSpace& space, std::size_t count, std::uint64_t seed);

/// Takes small and large steps from a point to another.
class PointChanger {
  public:
    /// `space` must outlive it.
    explicit PointChanger(const InputSpace& space);

    /// Changes that number of the point, or all of its field, within the domain: by a few roundings, by any
    /// power of two, to a hard number, or to some other number of the point. Returns the number.
    std::size_t change(std::span<double> point, std::size_t number, Random& random) const;

  private:
    [[nodiscard]] double changed_number(std::span<const double> point, const InputField& field, double number,
                                        Random& random) const;

    const InputSpace& space_;
    std::vector<std::size_t> field_of_;  ///< of each number of a point
};

}  // namespace gobo::sanitize
