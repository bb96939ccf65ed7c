#include "scene/light_reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/lit_volume.hpp"
#include "scene/motion.hpp"

namespace gobo::scene {
namespace {

/// What single precision may add to a distance: shaders compute in it. A light is dropped only if it misses
/// by more.
constexpr double relative_margin = 1e-5;

std::string_view name_of(LightKind kind) {
    switch (kind) {
        case LightKind::directional:
            return "directional";
        case LightKind::point:
            return "point";
        case LightKind::spot:
            return "spot";
    }
    return "point";
}

double brightest(const Light& light) {
    return std::max({light.color.r, light.color.g, light.color.b});
}

/// The radiance that arrives from a local light at a distance, at most.
double arriving(const Light& light, double distance) {
    const glm::dvec3& k = light.attenuation;
    return brightest(light) / std::max(k.x + distance * (k.y + distance * k.z), 1e-18);
}

/// The distance at which the light has fallen to the threshold; infinite where it never does.
double attenuated_reach(const Light& light, double threshold) {
    const glm::dvec3& k = light.attenuation;
    const double excess = k.x - brightest(light) / threshold;  // k_q d^2 + k_l d + excess = 0
    if (excess >= 0) return 0;
    if (k.z == 0) return k.y == 0 ? std::numeric_limits<double>::infinity() : -excess / k.y;
    return (-k.y + std::sqrt(k.y * k.y - 4 * k.z * excess)) / (2 * k.z);
}

/// Whether dot(normal, toward the light) can be positive nowhere on the surface, for any mean of the normals
/// at any point of the bounds: the expression is linear in each, so its corners decide.
bool faces_away(const PlacedLight& light, const Receiver& receiver) {
    if (receiver.normals.empty() || light.turns) return false;
    const bool is_directional = light.light->kind == LightKind::directional;
    if (!is_directional && !receiver.bounds) return false;
    return std::all_of(receiver.normals.begin(), receiver.normals.end(), [&](const glm::dvec3& normal) {
        if (is_directional) return glm::dot(normal, -light.direction) <= -relative_margin;
        const Box to_light = sum(light.positions, {-receiver.bounds->high, -receiver.bounds->low});
        const Box terms = product({normal, normal}, to_light);
        const double margin =
            relative_margin * glm::length(glm::max(glm::abs(to_light.low), glm::abs(to_light.high)));
        return terms.high.x + terms.high.y + terms.high.z <= -margin;
    });
}

/// Why a local light at some distance of the bounds cannot be seen on them; empty where it may.
std::string too_far(const Light& light, double distance, double threshold) {
    const double beyond = distance - light.range;
    if (beyond > relative_margin * distance)
        return fmt::format("bounds begin {:.3g} beyond its range of {:.3g}", beyond, light.range);
    if (arriving(light, distance) < threshold)
        return fmt::format("at {:.3g} it has fallen to {:.2g}, below {:.2g}", distance,
                           arriving(light, distance), threshold);
    return {};
}

std::string misses(const PlacedLight& light, const Box& bounds, double threshold) {
    if (light.light->outer_angle == 0) return "its cone is empty";
    if (light.turns || light.positions.low != light.positions.high || light.direction == glm::dvec3(0))
        return {};
    const double radius = std::min(light.light->range, attenuated_reach(*light.light, threshold));
    const LitVolume volume{light.positions.low, light.direction, light.light->outer_angle, radius};
    const double gap = proven_gap(volume, bounds);
    if (gap <= relative_margin * greatest_distance(light.positions, bounds)) return {};
    return fmt::format("cone misses bounds by {:.2g}", gap);
}

Verdict local_reach(const PlacedLight& light, const Receiver& receiver, double threshold) {
    if (!receiver.bounds) return {true, "bounds are not known"};
    const double distance = least_distance(light.positions, *receiver.bounds);
    const double least = threshold / receiver.response;
    std::string why = too_far(*light.light, distance, least);
    if (why.empty() && light.light->kind == LightKind::spot) why = misses(light, *receiver.bounds, least);
    if (!why.empty()) return {false, std::move(why)};
    if (faces_away(light, receiver)) return {false, "every normal faces away from it"};
    if (distance == 0) return {true, "it may be as near as can be"};
    return {true, fmt::format("at {:.3g} up to {:.2g} arrives", distance, arriving(*light.light, distance))};
}

}  // namespace

std::vector<PlacedLight> place_lights(const Scene& scene) {
    std::vector<PlacedLight> lights;
    std::array<int, 3> counts{};
    for (const int index : scene.order) {
        const Node& node = scene.nodes[static_cast<std::size_t>(index)];
        if (!node.light) continue;
        PlacedLight placed;
        placed.light = &scene.lights[static_cast<std::size_t>(*node.light)];
        placed.node = index;
        const int number = counts[static_cast<std::size_t>(placed.light->kind)]++;
        placed.label = fmt::format("{} {}", name_of(placed.light->kind), number);
        placed.positions = world_box(scene, index, {glm::dvec3(0), glm::dvec3(0)});
        placed.turns = is_moving(scene, index);
        const glm::dvec3 direction = glm::dmat3(node.world) * glm::dvec3(0, 0, -1);
        const double length = glm::length(direction);
        if (length > 0) placed.direction = direction / length;
        lights.push_back(std::move(placed));
    }
    return lights;
}

Verdict light_reach(const PlacedLight& light, const Receiver& receiver, double threshold) {
    if (brightest(*light.light) == 0) return {false, "its intensity is 0"};
    if (light.light->kind != LightKind::directional) return local_reach(light, receiver, threshold);
    const double least = threshold / receiver.response;
    if (brightest(*light.light) < least)
        return {false, fmt::format("its radiance is {:.2g}, below {:.2g}", brightest(*light.light), least)};
    if (faces_away(light, receiver)) return {false, "every normal faces away from it"};
    return {true, "it reaches everything"};
}

}  // namespace gobo::scene
