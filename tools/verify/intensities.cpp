#include "verify/intensities.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "oracle/lights.hpp"
#include "verify/rounding.hpp"

namespace gobo::verify {

/// A dot product of two unit vectors that are off by so much, and three roundings of at most 1.
std::vector<Expected> expect_intensities(const oracle::Model& model, const oracle::Scene& scene,
                                         const oracle::SurfacePoint& vertex, double position_error,
                                         double normal_error, oracle::Decisions& decisions) {
    std::vector<Expected> outputs;
    for (const oracle::Arrival& arrival : oracle::arrivals(model, scene, vertex.position, decisions)) {
        const double direction_error = arrival_errors(model, arrival, position_error).direction;
        outputs.push_back({fmt::format("lightIntensities[{}]", outputs.size()),
                           1,
                           {glm::dot(vertex.normal, arrival.to_light)},
                           {1},
                           {normal_error + direction_error + 3 * kUnitRoundoff}});
    }
    return outputs;
}

void hand_on_intensities(const oracle::Model& model, const oracle::Scene& scene, Random& random,
                         oracle::SurfacePoint& point) {
    oracle::Decisions decisions;
    const glm::dvec3 normal = oracle::direction_of(point.normal);
    for (const oracle::Arrival& arrival : oracle::arrivals(model, scene, point.position, decisions))
        point.intensities.push_back(glm::dot(normal, arrival.to_light) * random.between(0.7, 1));
}

}  // namespace gobo::verify
