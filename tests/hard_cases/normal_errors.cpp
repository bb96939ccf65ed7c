#include "normal_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gobo/normal_matrix.hpp>

#include "lab/sanitize/input_space.hpp"

namespace gobo {
namespace {

constexpr int kModels = 5000;
const glm::dvec3 kScale(1, 1, 1e4);

glm::dmat3 rotation(sanitize::Random& random) {
    // One after the other: compilers evaluate arguments in orders of their own.
    glm::dvec3 axis;
    axis.z = random.between(0.1, 1);
    axis.y = random.between(-1, 1);
    axis.x = random.between(-1, 1);
    return glm::dmat3(glm::rotate(glm::dmat4(1), random.between(0, 2 * std::numbers::pi), axis));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::mat3 plain_cofactors(const glm::mat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

NormalErrors errors_at(double away) {
    sanitize::Random random(1);
    NormalErrors largest{away, 0, 0};
    for (int i = 0; i < kModels; ++i) {
        const glm::dmat3 left = rotation(random);
        const glm::dmat3 right = rotation(random);
        const glm::dmat3 model = left * glm::dmat3(glm::scale(glm::dmat4(1), kScale)) * right;
        const double around = random.between(0, 2 * std::numbers::pi);
        const glm::dvec3 in_axes(std::sin(away) * std::cos(around), std::sin(away) * std::sin(around),
                                 std::cos(away));
        const glm::vec3 normal(glm::transpose(right) * in_axes);
        // Known in closed form: the inverse transpose of rotation, scale, rotation.
        const glm::dvec3 exact = left * ((right * glm::dvec3(normal)) / kScale);
        const glm::vec3 plain = plain_cofactors(glm::mat3(model)) * normal;
        const glm::vec3 ours = normal_matrix(glm::dmat4(model)) * normal;
        largest.plain = std::max(largest.plain, angle_between(glm::dvec3(plain), exact));
        largest.ours = std::max(largest.ours, angle_between(glm::dvec3(ours), exact));
    }
    return largest;
}

}  // namespace

std::vector<NormalErrors> normal_errors() {
    std::vector<NormalErrors> rows;
    for (const double away : {1.0, 0.1, 0.03, 0.01, 0.003, 0.001}) rows.push_back(errors_at(away));
    return rows;
}

}  // namespace gobo
