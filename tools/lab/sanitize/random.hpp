// Random numbers of the sanitizer: the standard library's generators cost more than the shaders they make
// inputs for.
#pragma once

#include "lab/raster/random_numbers.hpp"

namespace gobo::sanitize {

class Random : public RandomNumbers<Xoshiro256> {
  public:
    using RandomNumbers::RandomNumbers;

    /// True one time in `n`.
    [[nodiscard]] bool one_in(std::size_t n) { return index(n) == 0; }
};

}  // namespace gobo::sanitize
