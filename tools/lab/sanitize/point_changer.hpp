// Small and large steps from a point to another.
#pragma once

#include <span>
#include <vector>

#include "lab/sanitize/input_space.hpp"
#include "lab/sanitize/random.hpp"

namespace gobo::sanitize {

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
