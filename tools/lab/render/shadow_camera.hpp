// From where a light's shadow maps are drawn, in double precision.
#pragma once

#include <array>
#include <vector>

#include "lab/render/draw_list.hpp"

namespace gobo {

/// A light as far as its shadows are concerned, in world space.
struct ShadowLight {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::directional;
    glm::dvec3 position{0};   ///< of point and spot lights
    glm::dvec3 direction{0};  ///< unit: to a directional light, along which a spot light shines
    double half_angle = 0;    ///< of a spot light's cone, radians
};

/// One map: world space to the light's eye space, from there to its clip space.
struct ShadowCamera {
    glm::dmat4 view{1};
    glm::dmat4 projection{1};
};

/// A box along the axes of world space.
struct Bounds {
    glm::dvec3 low{0};
    glm::dvec3 high{0};
};

/// What must be on the maps: `casters` are the objects whose shadows are wanted, `all` is whatever they may
/// fall on.
struct ShadowedScene {
    Bounds casters;
    Bounds all;
};

/// The bounds of objects: those that cast shadows, and all. Objects without vertices have none.
[[nodiscard]] ShadowedScene shadowed_scene(const std::vector<Object>& objects);

/// The cameras of a light's maps: one, or six for a point light, in the order of OpenGL's cube maps (+x -x +y
/// -y +z -z), each a little wider than its face, by one of `side` texels at each border. Directional lights
/// show the casters' bounds, spot lights their cone.
[[nodiscard]] std::vector<ShadowCamera> shadow_cameras(const ShadowLight& light, const ShadowedScene& scene,
                                                       int side);

/// The numbers that a shader looks a light's maps up with: the members of lit's struct Shadow. `toMap` leads
/// from the eye space of a camera whose view matrix is `view`.
struct ShadowNumbers {
    glm::dmat4 to_map{1};
    double depth_scale = 0;
    double depth_shift = 0;
    double spread = 0.5;
};
[[nodiscard]] ShadowNumbers shadow_numbers(const ShadowLight& light, const ShadowCamera& first_camera,
                                           const glm::dmat4& view);

/// The cameras of all maps, layer by layer, and the values of lit's block `Shadows` that go with them.
struct ShadowPlan {
    std::vector<ShadowCamera> cameras;
    std::vector<RenderValue> values;
};
[[nodiscard]] ShadowPlan shadow_plan(const std::vector<ShadowLight>& lights,
                                     const std::vector<Object>& objects, const glm::dmat4& view, int side);

}  // namespace gobo
