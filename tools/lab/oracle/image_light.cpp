#include "lab/oracle/image_light.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

LookedUp look_up(const ImageLight& light, const glm::dvec3& direction) {
    const glm::dvec3 turned = glm::normalize(light.to_map * direction);
    LookedUp found{light.map.mean + light.map.slope * turned, glm::dvec3(0)};
    for (int column = 0; column < 3; ++column) found.slope += glm::abs(light.map.slope[column]);
    return found;
}

}  // namespace

LookedUp ambient_from_image(const ImageLight& light, const glm::dvec3& normal) {
    if (normal == glm::dvec3(0)) return {light.color, glm::dvec3(0)};
    const LookedUp found = look_up(light, normal);
    return {(1 - light.share) * light.color + light.share * found.value, light.share * found.slope};
}

LookedUp reflection_from_image(const ImageLight& light, const glm::dvec3& normal,
                               const glm::dvec3& to_viewer) {
    if (normal == glm::dvec3(0) || to_viewer == glm::dvec3(0)) return {};
    const LookedUp found = look_up(light, 2 * glm::dot(normal, to_viewer) * normal - to_viewer);
    return {light.share * found.value, light.share * found.slope};
}

}  // namespace gobo::oracle
