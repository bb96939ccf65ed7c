#include "scene/lit_volume.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::scene {
namespace {

/// Projections converge within a handful of steps unless the two nearly touch, where nothing is dropped
/// anyway.
constexpr int most_steps = 64;

/// The point of the infinite cone nearest to a point, both relative to the apex.
glm::dvec3 nearest_of_cone(const LitVolume& volume, const glm::dvec3& point) {
    const double along = glm::dot(point, volume.axis);
    const glm::dvec3 across = point - along * volume.axis;
    const double away = glm::length(across);
    const double cosine = std::cos(volume.half_angle);
    const double sine = std::sin(volume.half_angle);
    if (away * cosine <= along * sine) return point;
    const double on_edge =
        along * cosine + away * sine;  // how far along the cone's edge the nearest point lies
    if (on_edge <= 0) return glm::dvec3(0);
    return on_edge * (cosine * volume.axis + sine * (across / away));
}

/// The least value of dot(direction, point) over the box.
double least_along(const Box& box, const glm::dvec3& direction) {
    return glm::dot(direction, glm::dvec3(direction.x > 0 ? box.low.x : box.high.x,
                                          direction.y > 0 ? box.low.y : box.high.y,
                                          direction.z > 0 ? box.low.z : box.high.z));
}

}  // namespace

/// The nearest point of a cone cut by a ball about its apex is the ball's nearest point to the cone's
/// (Bauschke, Bui and Wang: Projecting onto the intersection of a cone and a sphere, SIAM J. Optim. 28,
/// 2018).
glm::dvec3 LitVolume::nearest_to(const glm::dvec3& point) const {
    const glm::dvec3 near = nearest_of_cone(*this, point - apex);
    const double distance = glm::length(near);
    return apex + (distance > radius ? near * (radius / distance) : near);
}

double proven_gap(const LitVolume& volume, const Box& box) {
    double gap = 0;
    glm::dvec3 in_box = box.nearest_to(volume.apex);
    for (int step = 0; step < most_steps; ++step) {
        const glm::dvec3 in_volume = volume.nearest_to(in_box);
        const glm::dvec3 apart = in_box - in_volume;
        const double distance = glm::length(apart);
        if (distance == 0) return 0;
        const glm::dvec3 normal = apart / distance;
        // The volume lies on the near side of the plane through in_volume, as that is its point nearest to
        // in_box.
        gap = std::max(gap, least_along(box, normal) - glm::dot(normal, in_volume));
        const glm::dvec3 next = box.nearest_to(in_volume);
        if (glm::length(next - in_box) <= 1e-12 * distance) break;
        in_box = next;
    }
    return gap;
}

}  // namespace gobo::scene
