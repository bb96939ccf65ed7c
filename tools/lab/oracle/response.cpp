#include "lab/oracle/response.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

glm::dvec3 mirrored(const glm::dvec3& normal, const glm::dvec3& to_light) {
    return 2 * glm::dot(normal, to_light) * normal - to_light;
}

/// The edge k / N nearest to the cosine decides between the bands on its two sides. There is none at 0 and 1.
double banded_factor(Diffuse diffuse, int levels, double cosine, Decisions& decisions) {
    const int edge = std::clamp(static_cast<int>(std::lround(cosine * levels)), 0, levels);
    const double at = static_cast<double>(edge) / levels;
    const bool is_inner = edge > 0 && edge < levels;
    int band = edge == levels ? levels - 1 : 0;  // counted from the darkest
    if (is_inner && diffuse == Diffuse::toon) band = decisions.above(at, cosine) ? edge - 1 : edge;
    if (is_inner && diffuse == Diffuse::toon_ceil) band = decisions.above(cosine, at) ? edge : edge - 1;
    return static_cast<double>(diffuse == Diffuse::toon ? band : band + 1) / levels;
}

double tone(const Scene& scene, double cosine, Decisions& decisions) {
    for (std::size_t i = 0; i < scene.toon_thresholds.size(); ++i)
        if (decisions.above(cosine, scene.toon_thresholds[i])) return scene.toon_tones[i];
    return 0;
}

/// Whether the radiance jumps where a light rises over the surface's horizon.
bool jumps_at_horizon(const Model& model) {
    return model.specular != Specular::none || model.diffuse == Diffuse::toon_ceil ||
           model.diffuse == Diffuse::toon_thresholds;
}

/// Models that end at a right angle are 0 from there on; at exponent 0 everything is 1.
double beyond_a_right_angle(double shininess) {
    return shininess > 0 ? 0 : 1;
}

double near_exact(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    const double z = (cosine - 1) / (cosine + 1);
    return std::exp(2 * shininess * (z + z * z * z / 3));
}

double schlick(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    return cosine / (shininess - shininess * cosine + cosine);
}

}  // namespace

double diffuse_factor(const Model& model, const Scene& scene, double cosine, Decisions& decisions) {
    if (model.diffuse == Diffuse::lambert) return cosine;
    if (model.diffuse == Diffuse::toon_thresholds) return tone(scene, cosine, decisions);
    return banded_factor(model.diffuse, scene.toon_levels, cosine, decisions);
}

double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                       const glm::dvec3& to_viewer) {
    if (specular == Specular::blinn) return angle_between(normal, to_light + to_viewer);
    return angle_between(mirrored(normal, to_light), to_viewer);
}

double lobe(Power power, double one_minus_cosine, double shininess) {
    const double cosine = 1 - one_minus_cosine;
    switch (power) {
        case Power::exact:
            break;
        case Power::near_exact:
            return near_exact(cosine, shininess);
        case Power::squaring:
            return std::pow(std::max(cosine, 0.0), std::nearbyint(shininess));
        case Power::gaussian_fitted:
            return std::exp((shininess + 0.664) * (cosine - 1));
        case Power::gaussian:
            return std::exp(shininess * (cosine - 1));
        case Power::lyon:
            return std::pow(std::max(1 - shininess * one_minus_cosine / 4, 0.0), 4);
        case Power::schlick:
            return schlick(cosine, shininess);
    }
    return std::pow(std::max(cosine, 0.0), shininess);
}

double one_minus_cosine_of(double angle) {
    const double half_sine = std::sin(angle / 2);
    return 2 * half_sine * half_sine;
}

double highlight_one_minus_cosine(const Model& model, const View& view, const glm::dvec3& to_light,
                                  std::size_t light) {
    const bool is_blinn = model.specular == Specular::blinn;
    const bool is_given = is_blinn && !view.halfways.empty();
    if (model.normal == Normal::renormalised) {
        return one_minus_cosine_of(
            is_given ? angle_between(view.normal, view.halfways[light])
                     : highlight_angle(model.specular, view.normal, to_light, view.to_viewer));
    }
    const glm::dvec3 half = is_given ? view.halfways[light] : direction_of(to_light + view.to_viewer);
    const double cosine =
        is_blinn ? glm::dot(view.normal, half) : glm::dot(mirrored(view.normal, to_light), view.to_viewer);
    return std::max(1 - cosine, 0.0);
}

LightTerm respond(const Model& model, const Scene& scene, const View& view, const IncidentLight& incident,
                  std::size_t light, Decisions& decisions) {
    LightTerm term;
    term.incident = incident;
    term.cosine = view.cosines.empty() ? glm::dot(view.normal, incident.to_light) : view.cosines[light];
    const bool has_highlight = model.specular != Specular::none;
    // Where the radiance is continuous at the horizon, nothing is decided there.
    term.is_lit = jumps_at_horizon(model) ? decisions.above(term.cosine, 0) : term.cosine > 0;
    if (!term.is_lit) return term;
    term.diffuse = diffuse_factor(model, scene, std::max(term.cosine, 0.0), decisions);
    if (!has_highlight) return term;
    term.highlight_one_minus_cosine = highlight_one_minus_cosine(model, view, incident.to_light, light);
    term.specular = lobe(model.power, term.highlight_one_minus_cosine, view.shininess);
    if (view.halfways.empty()) term.half_length = glm::length(incident.to_light + view.to_viewer);
    return term;
}

}  // namespace gobo::oracle
