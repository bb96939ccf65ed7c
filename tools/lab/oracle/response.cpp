#include "lab/oracle/response.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "lab/oracle/power.hpp"

namespace gobo::oracle {

namespace {

glm::dvec3 mirrored(const glm::dvec3& normal, const glm::dvec3& to_light) {
    return 2 * glm::dot(normal, to_light) * normal - to_light;
}

/// The edge k / N nearest to the cosine decides between the bands on its two sides. There is none at 0 and 1.
double banded_share(Diffuse diffuse, int levels, double cosine, Decisions& decisions) {
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

}  // namespace

double diffuse_share(const Model& model, const Scene& scene, double cosine, Decisions& decisions) {
    if (model.diffuse == Diffuse::lambert) return cosine;
    if (model.diffuse == Diffuse::toon_thresholds) return tone(scene, cosine, decisions);
    return banded_share(model.diffuse, scene.toon_levels, cosine, decisions);
}

double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                       const glm::dvec3& to_viewer) {
    if (specular == Specular::blinn) return angle_between(normal, to_light + to_viewer);
    return angle_between(mirrored(normal, to_light), to_viewer);
}

double versine_of(double angle) {
    const double half_sine = std::sin(angle / 2);
    return 2 * half_sine * half_sine;
}

double highlight_versine(const Model& model, const View& view, const glm::dvec3& to_light,
                         std::size_t light) {
    const bool is_blinn = model.specular == Specular::blinn;
    const bool is_given = is_blinn && !view.halfways.empty();
    if (model.normal == Normal::renormalised) {
        return versine_of(is_given ? angle_between(view.normal, view.halfways[light])
                                   : highlight_angle(model.specular, view.normal, to_light, view.to_viewer));
    }
    const glm::dvec3 half = is_given ? view.halfways[light] : direction_of(to_light + view.to_viewer);
    const double cosine =
        is_blinn ? glm::dot(view.normal, half) : glm::dot(mirrored(view.normal, to_light), view.to_viewer);
    return std::max(1 - cosine, 0.0);
}

LightTerm respond(const Model& model, const Scene& scene, const View& view, const Arrival& arrival,
                  std::size_t light, Decisions& decisions) {
    LightTerm term;
    term.arrival = arrival;
    term.cosine =
        view.intensities.empty() ? glm::dot(view.normal, arrival.to_light) : view.intensities[light];
    const bool has_highlight = model.specular != Specular::none;
    // Where the radiance is continuous at the horizon, nothing is decided there.
    term.is_lit = jumps_at_horizon(model) ? decisions.above(term.cosine, 0) : term.cosine > 0;
    if (!term.is_lit) return term;
    term.diffuse = diffuse_share(model, scene, std::max(term.cosine, 0.0), decisions);
    if (!has_highlight) return term;
    term.highlight_versine = highlight_versine(model, view, arrival.to_light, light);
    term.specular = lobe(model.power, term.highlight_versine, view.shininess);
    if (view.halfways.empty()) term.half_length = glm::length(arrival.to_light + view.to_viewer);
    return term;
}

}  // namespace gobo::oracle
