#include "oracle/oracle.hpp"

#include <algorithm>

#include <glm/common.hpp>

#include "oracle/shadow.hpp"

namespace gobo::oracle {

Radiance lit_radiance(const Model& model, const Scene& scene, const SurfacePoint& point,
                      Decisions& decisions) {
    const Material& material = scene.material;
    const glm::dvec3 normal = direction_of(point.normal);
    const glm::dvec3 to_viewer = direction_of(-point.position);
    const glm::dvec3 highlight = material.strength * material.specular;
    Radiance radiance;
    radiance.value = material.emission + material.ambient * scene.ambient;
    radiance.largest = radiance.value;
    std::vector<Arrival> lights = arrivals(scene, point.position, decisions);
    cast_shadows(model, scene, point.position, lights, decisions);
    for (const Arrival& arrival : lights) {
        const LightTerm term = respond(model, scene, normal, to_viewer, arrival, decisions);
        radiance.value += (material.diffuse * term.diffuse + highlight * term.specular) * arrival.radiance;
        radiance.largest += material.diffuse * arrival.unshaped;
        if (model.specular != Specular::none) radiance.largest += highlight * arrival.unshaped;
        radiance.terms.push_back(term);
    }
    return radiance;
}

Seen seen_through_fog(const Model& model, const Scene& scene, const glm::dvec3& position,
                      const glm::dvec3& radiance, const glm::dvec3& largest, Decisions& decisions) {
    if (model.fog == Fog::none) return {radiance, largest, 0, 1};
    const double distance = fog_distance(model.fog_distance, position);
    const double clear = clearness(model.fog, scene.fog, distance, decisions);
    return {clear * radiance + (1 - clear) * scene.fog.color, largest + scene.fog.color, distance, clear};
}

std::optional<double> written_depth(const Model& model, const Scene& scene, double depth) {
    const double offset = scene.depth_offset;
    switch (model.depth) {
        case Depth::untouched:
            return std::nullopt;
        case Depth::any:
            return std::clamp(depth + offset, 0.0, 1.0);
        case Depth::greater:
            return std::min(depth + std::max(offset, 0.0), 1.0);
        case Depth::less:
            return std::max(depth + std::min(offset, 0.0), 0.0);
        case Depth::unchanged:
            break;
    }
    return depth;
}

}  // namespace gobo::oracle
