#include "lab/render/shadow_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace gobo {
namespace {

/// No cone is drawn wider than this: at 90 degrees a projection has no end.
constexpr double kWidestHalfAngle = 1.4;
/// The near plane stands at this share of the distance to the far one, at least: a hundredth of the way costs
/// depth a factor of 100 in resolution at the far end.
constexpr double kNearest = 0.01;

Bounds nothing() {
    const double most = std::numeric_limits<double>::infinity();
    return {glm::dvec3(most), glm::dvec3(-most)};
}

void add(Bounds& bounds, const glm::dvec3& point) {
    bounds.low = glm::min(bounds.low, point);
    bounds.high = glm::max(bounds.high, point);
}

/// The box around a box after a transformation.
Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix) {
    Bounds result = nothing();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                               (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        add(result, glm::dvec3(matrix * glm::dvec4(point, 1)));
    }
    return result;
}

/// Any direction that is not nearly along `direction`.
glm::dvec3 up_for(const glm::dvec3& direction) {
    return std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

/// The depth range, a little wider, so that what lies at its ends is on the map. The near plane is where the
/// casters begin: what is before them casts no shadow of interest.
ShadowCamera directional_camera(const ShadowLight& light, const ShadowedScene& scene) {
    ShadowCamera camera;
    camera.view = glm::lookAt(light.direction, glm::dvec3(0), up_for(light.direction));
    const Bounds casters = transformed(scene.casters, camera.view);
    const Bounds all = transformed(scene.all, camera.view);
    const glm::dvec3 margin = 0.02 * (casters.high - casters.low) + 1e-6;
    camera.projection =
        glm::ortho(casters.low.x - margin.x, casters.high.x + margin.x, casters.low.y - margin.y,
                   casters.high.y + margin.y, -casters.high.z - margin.z, -all.low.z + margin.z);
    return camera;
}

/// The largest distance from a point to what is in the box.
double reach(const Bounds& bounds, const glm::dvec3& from) {
    return glm::length(glm::max(glm::abs(bounds.low - from), glm::abs(bounds.high - from)));
}

ShadowCamera spot_camera(const ShadowLight& light, const ShadowedScene& scene) {
    ShadowCamera camera;
    camera.view = glm::lookAt(light.position, light.position + light.direction, up_for(light.direction));
    const double far = 1.01 * reach(scene.all, light.position) + 1e-6;
    const double nearest = -transformed(scene.casters, camera.view).high.z;
    const double half = std::clamp(1.02 * light.half_angle, 1e-3, kWidestHalfAngle);
    camera.projection =
        glm::perspective(2 * half, 1.0, std::clamp(0.98 * nearest, kNearest * far, 0.9 * far), far);
    return camera;
}

std::vector<ShadowCamera> cube_cameras(const ShadowLight& light, const ShadowedScene& scene, int side) {
    const double far = 1.01 * reach(scene.all, light.position) + 1e-6;
    const double half = std::atan(1 + 2.0 / std::max(side, 3));
    const glm::dmat4 projection = glm::perspective(2 * half, 1.0, kNearest * far, far);
    struct Face {
        glm::dvec3 axis, up;
    };
    // OpenGL 4.5, table 8.19: the side along which t grows is up.
    const std::array<Face, 6> faces = {{{{1, 0, 0}, {0, -1, 0}},
                                        {{-1, 0, 0}, {0, -1, 0}},
                                        {{0, 1, 0}, {0, 0, 1}},
                                        {{0, -1, 0}, {0, 0, -1}},
                                        {{0, 0, 1}, {0, -1, 0}},
                                        {{0, 0, -1}, {0, -1, 0}}}};
    std::vector<ShadowCamera> cameras;
    for (const Face& face : faces)
        cameras.push_back({glm::lookAt(light.position, light.position + face.axis, face.up), projection});
    return cameras;
}

RenderValue value(std::size_t shadow, const char* member, std::vector<double> numbers) {
    RenderValue result;
    result.name = fmt::format("Shadows.shadows[{}].{}", shadow, member);
    result.numbers = std::move(numbers);
    return result;
}

void add_values(std::vector<RenderValue>& values, std::size_t shadow, int layer,
                const ShadowNumbers& numbers) {
    const double* matrix = glm::value_ptr(numbers.to_map);
    values.push_back(value(shadow, "toMap", {matrix, matrix + 16}));
    values.push_back(value(shadow, "layer", {static_cast<double>(layer)}));
    values.push_back(value(shadow, "depthScale", {numbers.depth_scale}));
    values.push_back(value(shadow, "depthShift", {numbers.depth_shift}));
    values.push_back(value(shadow, "spread", {numbers.spread}));
}

}  // namespace

ShadowedScene shadowed_scene(const std::vector<Object>& objects) {
    ShadowedScene scene{nothing(), nothing()};
    for (const Object& object : objects) {
        for (const glm::vec3& position : object.mesh.positions) {
            const glm::dvec3 point(object.model * glm::dvec4(position, 1));
            add(scene.all, point);
            if (object.casts_shadow) add(scene.casters, point);
        }
    }
    if (scene.casters.low.x > scene.casters.high.x) scene.casters = scene.all;
    if (scene.all.low.x > scene.all.high.x) scene.casters = scene.all = {glm::dvec3(-1), glm::dvec3(1)};
    return scene;
}

std::vector<ShadowCamera> shadow_cameras(const ShadowLight& light, const ShadowedScene& scene, int side) {
    switch (light.kind) {
        case ShadowLight::Kind::directional:
            return {directional_camera(light, scene)};
        case ShadowLight::Kind::spot:
            return {spot_camera(light, scene)};
        case ShadowLight::Kind::point:
            break;
    }
    return cube_cameras(light, scene, side);
}

ShadowNumbers shadow_numbers(const ShadowLight& light, const ShadowCamera& first_camera,
                             const glm::dmat4& view) {
    const glm::dmat4 to_world = glm::inverse(view);
    ShadowNumbers numbers;
    if (light.kind == ShadowLight::Kind::point) {
        numbers.to_map = glm::translate(glm::dmat4(1), -light.position) * to_world;
        // Window depth (1 + z_clip / w) / 2 with z_clip = projection[2][2] * -w + projection[3][2].
        numbers.depth_scale = 0.5 - 0.5 * first_camera.projection[2][2];
        numbers.depth_shift = 0.5 * first_camera.projection[3][2];
        numbers.spread = 0.5 * first_camera.projection[0][0];
        return numbers;
    }
    const glm::dmat4 halved = glm::translate(glm::dmat4(1), glm::dvec3(0.5)) *
                              glm::scale(glm::dmat4(1), glm::dvec3(0.5));  // -1 to 1 becomes 0 to 1
    numbers.to_map = halved * first_camera.projection * first_camera.view * to_world;
    return numbers;
}

ShadowPlan shadow_plan(const std::vector<ShadowLight>& lights, const std::vector<Object>& objects,
                       const glm::dmat4& view, int side) {
    const ShadowedScene scene = shadowed_scene(objects);
    ShadowPlan plan;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::vector<ShadowCamera> own = shadow_cameras(lights[i], scene, side);
        add_values(plan.values, i, static_cast<int>(plan.cameras.size()),
                   shadow_numbers(lights[i], own.front(), view));
        plan.cameras.insert(plan.cameras.end(), own.begin(), own.end());
    }
    return plan;
}

}  // namespace gobo
