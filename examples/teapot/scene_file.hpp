// A scene file, glTF 2.0 with `extras.gobo`, as far as this program's own files go.
#pragma once

#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "lit.hpp"
#include "mesh.hpp"

namespace teapot {

/// What the scene's own words say of how its draws are shaded. Members are named after features of lit:
/// lit::select() takes them.
struct Look {
    lit::Diffuse diffuse = lit::Diffuse::lambert;
    lit::Specular specular = lit::Specular::blinn;
    lit::Fog fog = lit::Fog::none;
    lit::Shading shading = lit::Shading::fragment;
};

/// A light where its node stands, in world space.
struct Light {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::point;
    glm::vec3 color{1};
    glm::vec3 attenuation{0, 0, 1};
    float exponent = 0;
    float inner_angle = 0;  ///< radians
    float outer_angle = 0;
    glm::vec3 position{0};
    glm::vec3 shines_along{0, 0, -1};
};

/// A mesh with a material, where its node stands.
struct Part {
    Mesh mesh;
    glm::mat4 model{1};
    lit::Material material{};
};

struct Scene {
    std::vector<Part> parts;
    std::vector<Light> lights;
    glm::mat4 view{1};         ///< world to eye space
    float vertical_angle = 0;  ///< of the camera, radians
    float near_plane = 0;
    float far_plane = 0;
    glm::vec3 ambient{0};
    glm::vec3 background{0};
    lit::Fog_block fog{};
    lit::Toon toon{};
    Look look;
};

/// Reads a scene and the buffers beside it. Throws std::runtime_error where it is not as this program's files
/// are: that a scene is in order is for `gobo scene` to tell.
Scene read_scene(const std::string& path);

}  // namespace teapot
