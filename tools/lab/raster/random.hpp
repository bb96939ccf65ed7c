// What samples are drawn from: random numbers and vectors, the same on every computer.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
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
    /// In any direction; its length is one of `across`.
    [[nodiscard]] glm::dvec3 vector(double shortest, double longest) {
        const double length = across(shortest, longest);
        return direction() * length;
    }
    /// About any axis, by an angle in [low, high) radians.
    [[nodiscard]] glm::dmat4 rotation(double low, double high) {
        const glm::dvec3 axis = direction();
        return glm::rotate(glm::dmat4(1), between(low, high), axis);
    }
};

}  // namespace gobo
