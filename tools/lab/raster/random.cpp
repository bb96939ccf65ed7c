#include "lab/raster/random.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace gobo {

double Random::unit() {
    return unit_interval(bits());
}

double Random::between(double low, double high) {
    return low + (high - low) * unit();
}

double Random::across(double low, double high) {
    return low * std::exp(std::log(high / low) * unit());
}

int Random::whole(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
}

bool Random::one_in(int n) {
    return whole(1, n) == 1;
}

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
