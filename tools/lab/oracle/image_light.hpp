// The light of an environment that is looked up in cube maps.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gobo::oracle {

/// What a cube map holds, as a function of the unit direction d: mean + slope d. Not negative where |slope d|
/// does not exceed the mean.
struct CubeMap {
    glm::dvec3 mean{0};
    glm::dmat3 slope{0};
};

/// A map looked up by a direction of eye space.
struct ImageLight {
    glm::dvec3 color{0};   ///< what the map is mixed with; reflections mix with nothing
    double share = 0;      ///< the map's, 0 to 1
    glm::dmat3 to_map{1};  ///< rotation from eye space to the map's axes
    CubeMap map;
};

/// Light looked up, with what its accuracy hangs on.
struct LookedUp {
    glm::dvec3 value{0};  ///< radiance
    glm::dvec3 slope{0};  ///< at most so much per unit of error of the direction
};

/// mix(color, map(normal), share); the color alone where the normal is zero.
[[nodiscard]] LookedUp ambient_from_image(const ImageLight& light, const glm::dvec3& normal);

/// share map(r) with r = 2 (n.v) n - v; nothing where either vector is zero.
[[nodiscard]] LookedUp reflection_from_image(const ImageLight& light, const glm::dvec3& normal,
                                             const glm::dvec3& to_viewer);

}  // namespace gobo::oracle
