#include "lab/verify/cosines.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lab/oracle/lights.hpp"
#include "lab/verify/field_access.hpp"
#include "lab/verify/rounding.hpp"

namespace gobo::verify {

/// Of each light, a dot product of two unit vectors that are off by so much, and three roundings of at
/// most 1.
std::vector<Expected> expect_cosines(const oracle::Model& model, const oracle::Scene& scene,
                                     const oracle::SurfacePoint& vertex, double position_error,
                                     double normal_error, oracle::Decisions& decisions) {
    std::vector<Expected> outputs;
    std::size_t light = 0;
    for (const oracle::IncidentLight& incident :
         oracle::incident_lights(model, scene, vertex.position, decisions)) {
        const std::size_t component = light++ % 4;
        if (component == 0)
            outputs.push_back({fmt::format("lightCosines[{}]", outputs.size()), 4, {}, {}, {}});
        Expected& element = outputs.back();
        element.value[component] = glm::dot(vertex.normal, incident.to_light);
        element.largest[component] = 1;
        element.float_error[component] =
            normal_error + incident_errors(model, incident, position_error).direction + 3 * kUnitRoundoff;
    }
    return outputs;
}

std::optional<Field> cosines_field(const std::string& name) {
    const auto element = element_name(name, "lightCosines");
    if (!element) return std::nullopt;
    const std::size_t first = 4 * element->index;
    return Field{[=](const Sample& sample) {
                     std::vector<double> values(4);
                     const std::vector<double>& all = sample.surface.cosines;
                     for (std::size_t i = 0; i < 4 && first + i < all.size(); ++i) values[i] = all[first + i];
                     return values;
                 },
                 [=](Sample& sample, const std::vector<double>& values) {
                     std::vector<double>& all = sample.surface.cosines;
                     all.resize(std::max(all.size(), first + 4));
                     std::copy(values.begin(), values.end(),
                               all.begin() + static_cast<std::ptrdiff_t>(first));
                 }};
}

void hand_on_cosines(const oracle::Model& model, const oracle::Scene& scene, Random& random,
                     oracle::SurfacePoint& point) {
    oracle::Decisions decisions;
    const glm::dvec3 normal = oracle::direction_of(point.normal);
    for (const oracle::IncidentLight& incident :
         oracle::incident_lights(model, scene, point.position, decisions))
        point.cosines.push_back(glm::dot(normal, incident.to_light) * random.between(0.7, 1));
}

}  // namespace gobo::verify
