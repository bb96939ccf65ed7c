#include "oracle/response.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::oracle {

double diffuse_share(const Model& model, int toon_levels, double cosine, Decisions& decisions) {
    if (model.diffuse == Diffuse::lambert) return cosine;
    // The edge k / N nearest to the cosine: the band begins at its lower edge. There is none at 0 and at 1.
    const int edge = static_cast<int>(std::lround(cosine * toon_levels));
    if (edge < 1) return 0;
    if (edge >= toon_levels) return (toon_levels - 1.0) / toon_levels;
    const bool is_below = decisions.above(static_cast<double>(edge) / toon_levels, cosine);
    return static_cast<double>(is_below ? edge - 1 : edge) / toon_levels;
}

double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                       const glm::dvec3& to_viewer) {
    if (specular == Specular::blinn) return angle_between(normal, to_light + to_viewer);
    const glm::dvec3 mirrored = 2 * glm::dot(normal, to_light) * normal - to_light;
    return angle_between(mirrored, to_viewer);
}

double lobe(double angle, double shininess) {
    return std::pow(std::max(std::cos(angle), 0.0), shininess);
}

LightTerm respond(const Model& model, const Scene& scene, const glm::dvec3& normal,
                  const glm::dvec3& to_viewer, const Arrival& arrival, Decisions& decisions) {
    LightTerm term;
    term.arrival = arrival;
    term.cosine = glm::dot(normal, arrival.to_light);
    const bool has_highlight = model.specular != Specular::none;
    // Without highlights the radiance is continuous at the horizon: nothing is decided there.
    term.is_lit = has_highlight ? decisions.above(term.cosine, 0) : term.cosine > 0;
    if (!term.is_lit) return term;
    term.diffuse = diffuse_share(model, scene.toon_levels, std::max(term.cosine, 0.0), decisions);
    if (!has_highlight) return term;
    term.highlight_angle = highlight_angle(model.specular, normal, arrival.to_light, to_viewer);
    term.specular = lobe(term.highlight_angle, scene.material.shininess);
    term.half_length = glm::length(arrival.to_light + to_viewer);
    return term;
}

}  // namespace gobo::oracle
