// Whether a light can reach a primitive, and why or why not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/scene.hpp"

namespace gobo::scene {

/// A light where a node puts it.
struct PlacedLight {
    const Light* light = nullptr;
    int node = 0;
    std::string label;        ///< "spot 2": its kind, and its number among the scene's of that kind, from 0
    Box positions;            ///< a point, or wherever its node moves
    bool turns = false;       ///< an animation may turn it
    glm::dvec3 direction{0};  ///< unit vector along which it shines, at rest; zero: none
};

/// The lights of the scene, in the order of its nodes.
[[nodiscard]] std::vector<PlacedLight> place_lights(const Scene& scene);

/// What light can reach. `bounds` is in world space; nothing: not known. `normals` are those of the surface
/// in world space, or empty where they are not known or both sides are lit.
struct Receiver {
    std::optional<Box> bounds;
    std::vector<glm::dvec3> normals;
    /// The greatest share of what arrives that the surface may give back towards one viewer: above 1 where a
    /// narrow highlight gathers it.
    double response = 1;
};

struct Verdict {
    bool is_in = false;
    std::string reason;
};

/// A light is out where it is black, where the bounds begin beyond its range, where its greatest radiance has
/// fallen so far there that the surface gives back less than `threshold`, where its cone misses them, or
/// where every normal faces away from it. It is in wherever none of this is certain.
[[nodiscard]] Verdict light_reach(const PlacedLight& light, const Receiver& receiver, double threshold);

}  // namespace gobo::scene
