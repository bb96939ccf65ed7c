#include "lab/oracle/lights.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

Arrival arrival_of(const PointLight& light, const glm::dvec3& position) {
    const glm::dvec3 ray = light.position - position;
    Arrival arrival;
    arrival.to_light = direction_of(ray);
    arrival.distance = glm::length(ray);
    arrival.fading = attenuation(light.attenuation, arrival.distance);
    arrival.unshaped = light.color * arrival.fading;
    arrival.radiance = arrival.unshaped;
    return arrival;
}

Arrival arrival_of(const Model& model, const SpotLight& light, const glm::dvec3& position,
                   Decisions& decisions) {
    Arrival arrival = arrival_of(static_cast<const PointLight&>(light), position);
    arrival.spot = &light;
    arrival.cone_angle = angle_between(light.axis, -arrival.to_light);
    arrival.radiance *= cone_share(light, arrival.cone_angle, decisions,
                                   angle_resolution(model.spot_edge, arrival.cone_angle));
    return arrival;
}

Arrival interpolated_arrival(const Model& model, const PointLight& light, const glm::dvec4& ray) {
    Arrival arrival;
    arrival.to_light = shading_direction(model, glm::dvec3(ray));
    arrival.fading = std::max(ray.w, 0.0);
    arrival.radiance = arrival.unshaped = light.color * arrival.fading;
    arrival.is_interpolated = true;
    return arrival;
}

Arrival arrival_of(const DirectionalLight& light) {
    Arrival arrival;
    arrival.to_light = light.direction;
    arrival.radiance = arrival.unshaped = light.color;
    arrival.is_given = true;
    return arrival;
}

Arrival arrival_of(const HomogeneousLight& light, const glm::dvec3& position) {
    const glm::dvec3 place(light.position);
    if (std::abs(light.position.w) < 0x1p-20) {
        Arrival arrival = arrival_of(DirectionalLight{direction_of(place), light.color});
        arrival.is_given = false;
        return arrival;
    }
    const PointLight local{place / light.position.w, light.color, light.attenuation};
    Arrival arrival = arrival_of(local, position);
    arrival.place_size = light.position.w == 1 ? 0 : glm::length(local.position);
    return arrival;
}

}  // namespace

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    // atan2(|a x b|, a.b): relative accuracy at every angle, where acos has none near 0 and pi.
    const double sine = glm::length(glm::cross(a, b));
    const double cosine = glm::dot(a, b);
    return sine == 0 && cosine == 0 ? std::acos(0.0) : std::atan2(sine, cosine);
}

glm::dvec3 direction_of(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? vector / length : glm::dvec3(0);
}

double attenuation(const glm::dvec3& coefficients, double distance) {
    const double denominator =
        coefficients[0] + coefficients[1] * distance + coefficients[2] * distance * distance;
    return 1 / std::max(denominator, 1e-18);
}

double angle_resolution(SpotEdge edge, double angle) {
    if (edge == SpotEdge::versine) return 1;
    return std::max(1.0, 0x1p-21 / (kEdgeWidth * std::max(std::sin(angle), 1e-4)));
}

double cone_share(const SpotLight& light, double angle, Decisions& decisions, double resolution) {
    const double half_sine = std::sin(angle / 2);
    const double versine = 2 * half_sine * half_sine;
    const double fade_width = light.outer_versine - light.inner_versine;
    double edge = 0;
    if (light.outer_versine >= 2) {  // all directions, the one straight back too
        edge = fade_width > 0 ? std::clamp((2 - versine) / fade_width, 0.0, 1.0) : 1;
    } else if (fade_width > 0) {
        edge = std::clamp((light.outer_versine - versine) / fade_width, 0.0, 1.0);
    } else {
        // Angles decide, since a versine of 5e-5 is a cone of 0.01 radians.
        const double outer_angle = 2 * std::asin(std::sqrt(light.outer_versine / 2));
        edge = decisions.above(outer_angle / resolution, angle / resolution) ? 1 : 0;
    }
    const double falloff = std::pow(std::max(std::cos(angle), 0.0), light.exponent);  // 0^0 is 1
    return edge * edge * falloff;
}

glm::dvec3 shading_direction(const Model& model, const glm::dvec3& given) {
    return model.normal == Normal::renormalised ? direction_of(given) : given;
}

std::vector<Arrival> interpolated_arrivals(const Model& model, const Scene& scene,
                                           const SurfacePoint& point) {
    std::vector<Arrival> result;
    for (const DirectionalLight& light : scene.directional) result.push_back(arrival_of(light));
    for (std::size_t i = 0; i < scene.point.size(); ++i)
        result.push_back(interpolated_arrival(model, scene.point[i], point.rays[i]));
    for (std::size_t i = 0; i < scene.spot.size(); ++i)
        result.push_back(interpolated_arrival(model, scene.spot[i], point.rays[scene.point.size() + i]));
    return result;
}

std::vector<Arrival> arrivals(const Model& model, const Scene& scene, const glm::dvec3& position,
                              Decisions& decisions) {
    std::vector<Arrival> result;
    for (const DirectionalLight& light : scene.directional) result.push_back(arrival_of(light));
    for (const PointLight& light : scene.point) result.push_back(arrival_of(light, position));
    for (const SpotLight& light : scene.spot) result.push_back(arrival_of(model, light, position, decisions));
    for (const HomogeneousLight& light : scene.homogeneous) result.push_back(arrival_of(light, position));
    return result;
}

}  // namespace gobo::oracle
