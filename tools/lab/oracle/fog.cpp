#include "lab/oracle/fog.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

double linear_clearness(const FogParameters& fog, double distance, Decisions& decisions) {
    if (fog.near != fog.far) return std::clamp((fog.far - distance) / (fog.far - fog.near), 0.0, 1.0);
    const double unit = std::max(fog.far, distance);  // the deciding quantity is a ratio of distances
    if (unit == 0) return 0;
    return decisions.above(fog.far / unit, distance / unit) ? 1 : 0;
}

}  // namespace

double fog_distance(FogDistance kind, const glm::dvec3& position) {
    return kind == FogDistance::radial ? glm::length(position) : std::abs(position.z);
}

double clearness(Fog kind, const FogParameters& fog, double distance, Decisions& decisions) {
    const double thickness = fog.density * distance;
    switch (kind) {
        case Fog::none:
            break;
        case Fog::linear:
            return linear_clearness(fog, distance, decisions);
        case Fog::exponential:
            return std::exp(-thickness);
        case Fog::exponential_squared:
            return std::exp(-thickness * thickness);
    }
    return 1;
}

}  // namespace gobo::oracle
