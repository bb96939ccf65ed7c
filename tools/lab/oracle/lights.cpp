#include "lab/oracle/lights.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

/// KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0).
double range_window(const Model& model, const PointLight& light, double distance) {
    if (model.light_range == LightRange::unlimited) return 1;
    return std::clamp(1 - std::pow(distance * light.nearness, 4), 0.0, 1.0);
}

IncidentLight incident_light_of(const Model& model, const PointLight& light, const glm::dvec3& position) {
    const glm::dvec3 ray = light.position - position;
    IncidentLight incident;
    incident.to_light = direction_of(ray);
    incident.distance = glm::length(ray);
    incident.window = range_window(model, light, incident.distance);
    incident.attenuation = attenuation(light.attenuation, incident.distance);
    incident.unshaped = light.color * incident.attenuation;
    incident.radiance = incident.window * incident.unshaped;
    return incident;
}

IncidentLight incident_light_of(const Model& model, const SpotLight& light, const glm::dvec3& position,
                                Decisions& decisions) {
    IncidentLight incident = incident_light_of(model, static_cast<const PointLight&>(light), position);
    incident.spot = &light;
    incident.cone_angle = angle_between(light.axis, -incident.to_light);
    incident.radiance *= cone_weight(light, incident.cone_angle, decisions,
                                     angle_resolution(model.spot_edge, incident.cone_angle));
    return incident;
}

IncidentLight interpolated_incident_light(const Model& model, const PointLight& light,
                                          const glm::dvec4& ray) {
    IncidentLight incident;
    incident.to_light = shading_direction(model, glm::dvec3(ray));
    incident.attenuation = std::max(ray.w, 0.0);
    incident.radiance = incident.unshaped = light.color * incident.attenuation;
    incident.is_interpolated = true;
    return incident;
}

IncidentLight incident_light_of(const DirectionalLight& light) {
    IncidentLight incident;
    incident.to_light = light.direction;
    incident.radiance = incident.unshaped = light.color;
    incident.is_given = true;
    return incident;
}

IncidentLight incident_light_of(const Model& model, const DirectionalOrPointLight& light,
                                const glm::dvec3& position) {
    const glm::dvec3 place(light.position);
    if (std::abs(light.position.w) < 0x1p-20) {
        IncidentLight incident = incident_light_of(DirectionalLight{direction_of(place), light.color});
        incident.is_given = false;
        return incident;
    }
    const PointLight local{place / light.position.w, light.color, light.attenuation};
    IncidentLight incident = incident_light_of(model, local, position);
    incident.place_size = light.position.w == 1 ? 0 : glm::length(local.position);
    return incident;
}

}  // namespace

bool Decisions::above(double quantity, double edge) {
    const double distance = std::abs(quantity - edge);
    nearest_ = std::min(nearest_, distance);
    const bool answer = quantity > edge;
    if (distance > kEdgeWidth) return answer;
    const bool is_flipped = open_ < 32 && (flipped_ >> open_ & 1U) != 0;
    ++open_;
    return answer != is_flipped;
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    // atan2(|a x b|, a.b): relative accuracy at every angle, where acos has none near 0 and pi.
    const double sine = glm::length(glm::cross(a, b));
    const double cosine = glm::dot(a, b);
    return sine == 0 && cosine == 0 ? std::acos(0.0) : std::atan2(sine, cosine);
}

double one_minus_cosine_of(double angle) {
    const double half_sine = std::sin(angle / 2);
    return 2 * half_sine * half_sine;
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
    if (edge == SpotEdge::one_minus_cosine) return 1;
    return std::max(1.0, 0x1p-21 / (kEdgeWidth * std::max(std::sin(angle), 1e-4)));
}

double cone_weight(const SpotLight& light, double angle, Decisions& decisions, double resolution) {
    const double one_minus_cosine = one_minus_cosine_of(angle);
    const double fade_width = light.outer_one_minus_cosine - light.inner_one_minus_cosine;
    double edge = 0;
    if (light.outer_one_minus_cosine >= 2) {  // all directions, the one straight back too
        edge = fade_width > 0 ? std::clamp((2 - one_minus_cosine) / fade_width, 0.0, 1.0) : 1;
    } else if (fade_width > 0) {
        edge = std::clamp((light.outer_one_minus_cosine - one_minus_cosine) / fade_width, 0.0, 1.0);
    } else {
        // Angles decide, since a 1 - cos of 5e-5 is a cone of 0.01 radians.
        const double outer_angle = 2 * std::asin(std::sqrt(light.outer_one_minus_cosine / 2));
        edge = decisions.above(outer_angle / resolution, angle / resolution) ? 1 : 0;
    }
    const double falloff = std::pow(std::max(std::cos(angle), 0.0), light.exponent);  // 0^0 is 1
    return edge * edge * falloff;
}

glm::dvec3 shading_direction(const Model& model, const glm::dvec3& given) {
    return model.normal == Normal::renormalised ? direction_of(given) : given;
}

std::vector<IncidentLight> interpolated_incident_lights(const Model& model, const Scene& scene,
                                                        const SurfacePoint& point) {
    std::vector<IncidentLight> result;
    for (const DirectionalLight& light : scene.directional) result.push_back(incident_light_of(light));
    for (std::size_t i = 0; i < scene.point.size(); ++i)
        result.push_back(interpolated_incident_light(model, scene.point[i], point.rays[i]));
    for (std::size_t i = 0; i < scene.spot.size(); ++i)
        result.push_back(
            interpolated_incident_light(model, scene.spot[i], point.rays[scene.point.size() + i]));
    return result;
}

std::vector<IncidentLight> incident_lights(const Model& model, const Scene& scene, const glm::dvec3& position,
                                           Decisions& decisions) {
    std::vector<IncidentLight> result;
    for (const DirectionalLight& light : scene.directional) result.push_back(incident_light_of(light));
    for (const PointLight& light : scene.point) result.push_back(incident_light_of(model, light, position));
    for (const SpotLight& light : scene.spot)
        result.push_back(incident_light_of(model, light, position, decisions));
    for (const DirectionalOrPointLight& light : scene.directional_or_point)
        result.push_back(incident_light_of(model, light, position));
    return result;
}

}  // namespace gobo::oracle
