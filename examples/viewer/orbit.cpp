#include "orbit.hpp"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace viewer {
namespace {

constexpr double vertical_angle = 0.7;

}  // namespace

double Orbit::distance() const {
    return radius / std::sin(vertical_angle / 2);
}

glm::dmat4 Orbit::view() const {
    const glm::dvec3 toward(std::sin(angle) * std::cos(height), std::sin(height),
                            std::cos(angle) * std::cos(height));
    return glm::lookAt(center + distance() * toward, center, glm::dvec3(0, 1, 0));
}

glm::dmat4 Orbit::projection(double aspect) const {
    return glm::perspective(vertical_angle, aspect, (distance() - radius) * 0.9, (distance() + radius) * 1.1);
}

}  // namespace viewer
