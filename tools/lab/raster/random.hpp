// What samples are drawn from: random numbers and vectors, the same on every computer.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lab/raster/random_numbers.hpp"

namespace gobo {

class Random : public RandomNumbers<SplitMix64> {
  public:
    using RandomNumbers::RandomNumbers;

    /// Each component in [low, high).
    [[nodiscard]] glm::dvec3 components(double low, double high) {
        const double x = between(low, high);
        const double y = between(low, high);
        return {x, y, between(low, high)};
    }
    /// A unit vector, all directions alike.
    [[nodiscard]] glm::dvec3 direction() {
        for (;;) {  // four points of the cube out of ten lie outside the ball
            const glm::dvec3 point = components(-1, 1);
            const double square = glm::dot(point, point);
            if (square <= 1 && square > 1e-4) return point / std::sqrt(square);
        }
    }
};

}  // namespace gobo
