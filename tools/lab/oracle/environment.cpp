#include "lab/oracle/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lab/oracle/lights.hpp"

namespace gobo::oracle {
namespace {

/// One term of the irradiance polynomial: a coefficient, its factor at n, and how fast the factor may change.
struct Term {
    std::size_t coefficient;
    int order;
    double factor;
    double slope;
};

std::array<Term, 9> terms_at(const glm::dvec3& n) {
    constexpr double c1 = 0.429043;
    constexpr double c2 = 0.511664;
    constexpr double c3 = 0.743125;
    constexpr double c4 = 0.886227;
    constexpr double c5 = 0.247708;
    return {{{0, 0, c4, 0},
             {1, 1, 2 * c2 * n.y, 2 * c2},
             {2, 1, 2 * c2 * n.z, 2 * c2},
             {3, 1, 2 * c2 * n.x, 2 * c2},
             {4, 2, 2 * c1 * n.x * n.y, 4 * c1},
             {5, 2, 2 * c1 * n.y * n.z, 4 * c1},
             {6, 2, c3 * n.z * n.z - c5, 2 * c3},
             {7, 2, 2 * c1 * n.x * n.z, 4 * c1},
             {8, 2, c1 * (n.x * n.x - n.y * n.y), 4 * c1}}};
}

int last_order(Harmonics order) {
    return 2 - static_cast<int>(order);
}

/// How much longer a matrix makes a vector at most: 1 for rotations. The 16th root of the Frobenius norm of
/// (A^T A)^8 is at least that, and at most 3^(1/32) = 1.035 times as much.
double largest_stretch(const glm::dmat3& matrix) {
    glm::dmat3 power = glm::transpose(matrix) * matrix;
    for (int squaring = 0; squaring < 3; ++squaring) power = power * power;
    double squares = 0;
    for (int column = 0; column < 3; ++column) squares += glm::dot(power[column], power[column]);
    const double stretch = std::pow(squares, 1.0 / 32);
    return stretch < 1.04 ? 1 : stretch;
}

LookedUp look_up(const ImageLight& light, const glm::dvec3& direction) {
    const glm::dvec3 turned = glm::normalize(light.to_map * direction);
    LookedUp found{light.map.mean + light.map.slope * turned, glm::dvec3(0)};
    for (int column = 0; column < 3; ++column) found.slope += glm::abs(light.map.slope[column]);
    return found;
}

}  // namespace

double sky_weight(Hemisphere kind, double angle, double length) {
    if (length == 0) return 0.5;
    if (kind == Hemisphere::cosine) return 0.5 + 0.5 * length * std::cos(angle);
    const double beyond_half = 0.5 * length * (1 - std::sin(angle));  // 0 at a right angle, of any length
    return angle <= std::numbers::pi / 2 ? 0.5 + beyond_half : 0.5 - beyond_half;
}

AmbientLight hemisphere_light(Hemisphere kind, const HemisphereLight& light, const glm::dvec3& normal) {
    const double weight = sky_weight(kind, angle_between(normal, light.up), glm::length(normal));
    return {weight * light.sky + (1 - weight) * light.ground, light.sky + light.ground,
            0.5 * glm::abs(light.sky - light.ground)};
}

glm::dvec3 irradiance(Harmonics order, const std::array<glm::dvec3, 9>& coefficients, const glm::dvec3& n) {
    glm::dvec3 sum{0};
    for (const Term& term : terms_at(n))
        if (term.order <= last_order(order)) sum += term.factor * coefficients[term.coefficient];
    return sum;
}

AmbientLight harmonics_light(Harmonics order, const HarmonicsLight& light, const glm::dvec3& normal) {
    const glm::dvec3 n = light.to_probe * normal;
    const double stretch = largest_stretch(light.to_probe);
    AmbientLight result;
    result.value = glm::max(light.scale * irradiance(order, light.coefficients, n), glm::dvec3(0));
    for (const Term& term : terms_at(n)) {
        if (term.order > last_order(order)) continue;
        const glm::dvec3 size = light.scale * glm::abs(light.coefficients[term.coefficient]);
        // Of whatever unit normal rounding gives: its factors reach 1.03, which the roundings count, and more
        // where the matrix is no rotation.
        result.largest += size * std::max(1.0, std::pow(stretch, term.order));
        result.slope += term.slope * size;
    }
    return result;
}

LookedUp ambient_from_image(const ImageLight& light, const glm::dvec3& normal) {
    if (normal == glm::dvec3(0)) return {light.color, glm::dvec3(0)};
    const LookedUp found = look_up(light, normal);
    return {(1 - light.weight) * light.color + light.weight * found.value, light.weight * found.slope};
}

LookedUp reflection_from_image(const ImageLight& light, const glm::dvec3& normal,
                               const glm::dvec3& to_viewer) {
    if (normal == glm::dvec3(0) || to_viewer == glm::dvec3(0)) return {};
    const LookedUp found = look_up(light, 2 * glm::dot(normal, to_viewer) * normal - to_viewer);
    return {light.weight * found.value, light.weight * found.slope};
}

}  // namespace gobo::oracle
