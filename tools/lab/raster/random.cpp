#include "lab/raster/random.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace gobo {

glm::dvec3 Random::components(double low, double high) {
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
}

glm::dvec3 Random::direction() {
    for (;;) {  // four points of the cube out of ten lie outside the ball
        const glm::dvec3 point = components(-1, 1);
        const double square = glm::dot(point, point);
        if (square <= 1 && square > 1e-4) return point / std::sqrt(square);
    }
}

}  // namespace gobo
