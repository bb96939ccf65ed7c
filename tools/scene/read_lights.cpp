// Lights and cameras.
#include <numbers>

#include <fmt/format.h>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double right_angle = std::numbers::pi / 2;
/// Angles are written in single precision as a rule: pi / 2 rounded up must pass.
constexpr double angle_slack = 1e-6;

LightKind read_kind(Document& document, const Value& value) {
    const auto kind = document.choice(value, "type", {"directional", "point", "spot"});
    if (!kind) document.error(path_to(value, "type"), "is missing");
    if (kind == "directional") return LightKind::directional;
    return kind == "spot" ? LightKind::spot : LightKind::point;
}

void read_cone(Document& document, const Value& value, Light& light) {
    light.outer_angle = std::numbers::pi / 4;
    const auto cone = document.object(value, "spot");
    if (!cone) return;
    const double widest = right_angle + angle_slack;
    light.inner_angle = document.number_within(*cone, "innerConeAngle", 0, widest).value_or(0);
    light.outer_angle =
        document.number_within(*cone, "outerConeAngle", 0, widest).value_or(light.outer_angle);
    light.outer_angle = std::min(light.outer_angle, right_angle);
    if (light.inner_angle > light.outer_angle + angle_slack) {
        document.error(
            path_to(*cone, "innerConeAngle"),
            fmt::format("is {:g}, wider than outerConeAngle, {:g}", light.inner_angle, light.outer_angle));
    }
    light.inner_angle = std::min(light.inner_angle, light.outer_angle);
}

void read_light_extras(Document& document, const Value& value, Light& light) {
    const auto extras = gobo_extras(document, value);
    if (!extras) return;
    document.only(*extras, {"attenuation", "exponent", "shadow"});
    if (const auto coefficients = read_color(document, *extras, "attenuation"))
        light.attenuation = *coefficients;
    light.exponent = document.number_within(*extras, "exponent", 0, 1e6).value_or(0);
    light.casts_shadow = document.boolean(*extras, "shadow").value_or(false);
}

Light read_light(Document& document, const Value& value) {
    Light light;
    light.name = document.string(value, "name").value_or("");
    light.kind = read_kind(document, value);
    light.color = read_color(document, value, "color").value_or(glm::dvec3(1));
    light.color *= document.number_within(value, "intensity", 0, unbounded).value_or(1);
    if (const auto range = document.number(value, "range")) {
        light.range = *range;
        if (*range <= 0)
            document.error(path_to(value, "range"), fmt::format("is {:g}, but must be above 0", *range));
    }
    if (light.kind == LightKind::spot) read_cone(document, value, light);
    read_light_extras(document, value, light);
    return light;
}

void read_perspective(Document& document, const Value& value, Camera& camera) {
    const auto view = document.object(value, "perspective");
    if (!view) {
        document.error(path_to(value, "perspective"), "is missing");
        return;
    }
    camera.vertical_angle = document.required_number(*view, "yfov");
    camera.near_plane = document.required_number(*view, "znear");
    camera.far_plane = document.number(*view, "zfar").value_or(unbounded);
    camera.aspect = document.number(*view, "aspectRatio");
    if (camera.vertical_angle <= 0 || camera.vertical_angle >= std::numbers::pi) {
        document.error(path_to(*view, "yfov"),
                       fmt::format("is {:g}, but must be an angle between 0 and pi", camera.vertical_angle));
    }
    if (camera.near_plane <= 0 || camera.far_plane <= camera.near_plane) {
        document.error(view->path, "must have 0 < znear < zfar");
    }
    if (camera.aspect && *camera.aspect <= 0)
        document.error(path_to(*view, "aspectRatio"), "must be above 0");
}

void read_orthographic(Document& document, const Value& value, Camera& camera) {
    const auto view = document.object(value, "orthographic");
    if (!view) {
        document.error(path_to(value, "orthographic"), "is missing");
        return;
    }
    camera.half_extent = {document.required_number(*view, "xmag"), document.required_number(*view, "ymag")};
    camera.near_plane = document.required_number(*view, "znear");
    camera.far_plane = document.required_number(*view, "zfar");
    if (camera.half_extent.x == 0 || camera.half_extent.y == 0) {
        document.error(view->path, "must have xmag and ymag other than 0");
    }
    if (camera.near_plane < 0 || camera.far_plane <= camera.near_plane) {
        document.error(view->path, "must have 0 <= znear < zfar");
    }
}

}  // namespace

void read_lights(Document& document, Scene& scene) {
    const auto extensions = document.object(document.root(), "extensions");
    if (!extensions) return;
    const auto extension = document.object(*extensions, "KHR_lights_punctual");
    if (!extension) return;
    for (const Value& value : document.objects(*extension, "lights"))
        scene.lights.push_back(read_light(document, value));
}

void read_cameras(Document& document, Scene& scene) {
    for (const Value& value : document.objects(document.root(), "cameras")) {
        Camera camera;
        camera.name = document.string(value, "name").value_or("");
        const auto kind = document.choice(value, "type", {"perspective", "orthographic"});
        if (!kind) document.error(path_to(value, "type"), "is missing");
        camera.is_perspective = kind != "orthographic";
        if (camera.is_perspective) {
            read_perspective(document, value, camera);
        } else {
            read_orthographic(document, value, camera);
        }
        scene.cameras.push_back(std::move(camera));
    }
}

}  // namespace gobo::scene
