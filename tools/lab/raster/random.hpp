// What samples are drawn from: random numbers and vectors, the same on every computer.
#pragma once

#include <glm/vec3.hpp>

#include "lab/raster/random_numbers.hpp"

namespace gobo {

class Random : public RandomNumbers<SplitMix64> {
  public:
    using RandomNumbers::RandomNumbers;

    /// Each component in [low, high).
    [[nodiscard]] glm::dvec3 components(double low, double high);
    /// A unit vector, all directions alike.
    [[nodiscard]] glm::dvec3 direction();
};

}  // namespace gobo
