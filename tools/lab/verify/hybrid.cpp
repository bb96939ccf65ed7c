#include "lab/verify/hybrid.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lab/oracle/oracle.hpp"
#include "lab/verify/rounding.hpp"

namespace gobo::verify {
namespace {

/// The scene with local lights that are white and 1 bright: what arrives of them is their share. Incident
/// lights refer to the lights of their scene.
oracle::Scene with_white_lights(oracle::Scene scene) {
    for (oracle::PointLight& light : scene.point) light.color = glm::dvec3(1);
    for (oracle::SpotLight& light : scene.spot) light.color = glm::dvec3(1);
    return scene;
}

Expected expect_ray(std::size_t index, const oracle::IncidentLight& incident, const IncidentErrors& errors) {
    Expected result{fmt::format("lightRays[{}]", index), 4, {}, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        result.value[i] = incident.to_light[static_cast<int>(i)];
        result.largest[i] = 1;
        result.float_error[i] = errors.direction;
    }
    result.value[3] = incident.radiance.x;
    result.largest[3] = incident.unshaped.x;
    result.float_error[3] = errors.radiance.x;
    return result;
}

Expected expect_halfway(std::size_t index, const glm::dvec3& half, double error) {
    Expected result{fmt::format("lightsHalfways[{}]", index), 3, {}, {}, {}};
    const glm::dvec3 direction = oracle::direction_of(half);
    // As a double evaluation is judged by the largest term, which is what the sum was divided by.
    const double largest = 1 / std::max(glm::length(half), 1e-6);
    for (std::size_t i = 0; i < 3; ++i) {
        result.value[i] = direction[static_cast<int>(i)];
        result.largest[i] = std::max(largest, 1.0);
        result.float_error[i] = error;
    }
    return result;
}

glm::dvec3 shortened(const glm::dvec3& direction, Random& random) {
    return direction * random.between(0.3, 1);
}

}  // namespace

std::vector<Expected> expect_handed_on(const oracle::Model& model, const oracle::Scene& scene,
                                       const glm::dvec3& position, double position_error,
                                       oracle::Decisions& decisions) {
    std::vector<Expected> outputs;
    const glm::dvec3 to_viewer = oracle::to_viewer(model, position);
    const double viewer = viewer_error(model, position, position_error);
    const oracle::Scene white = with_white_lights(scene);
    std::size_t number = 0;
    for (const oracle::IncidentLight& incident : oracle::incident_lights(model, white, position, decisions)) {
        const IncidentErrors errors = incident_errors(model, incident, position_error);
        if (number >= scene.directional.size())
            outputs.push_back(expect_ray(number - scene.directional.size(), incident, errors));
        const glm::dvec3 half = incident.to_light + to_viewer;
        outputs.push_back(
            expect_halfway(number, half, halfway_error(errors.direction, viewer, glm::length(half))));
        ++number;
    }
    return outputs;
}

void hand_on(const oracle::Model& model, const oracle::Scene& scene, Random& random,
             oracle::SurfacePoint& point) {
    oracle::Decisions decisions;
    const glm::dvec3 to_viewer = oracle::to_viewer(model, point.position);
    const oracle::Scene white = with_white_lights(scene);
    std::size_t number = 0;
    for (const oracle::IncidentLight& incident :
         oracle::incident_lights(model, white, point.position, decisions)) {
        if (number++ >= scene.directional.size()) {
            const double share = incident.radiance.x * random.between(0.9, 1.1);
            point.rays.emplace_back(shortened(incident.to_light, random),
                                    random.one_in(16) ? -0.01 * share : share);
        }
        point.halfways.push_back(shortened(oracle::direction_of(incident.to_light + to_viewer), random));
    }
}

}  // namespace gobo::verify
