#include "scene/read_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/text.hpp"
#include "scene/material_extensions.hpp"
#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// What the file may require. A transform of textures is of no concern: colours are not sampled, and what is
/// cut by a transformed picture is taken to be cut anywhere.
const std::vector<std::string> kKnownExtensions = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",  "KHR_materials_emissive_strength",
    "KHR_materials_specular",  "KHR_materials_unlit",  "KHR_mesh_quantization",
    "KHR_node_visibility",     "KHR_texture_transform"};

/// What is drawn without them is the same: they hold another copy of what core glTF holds beside them, or
/// words about the file.
const std::vector<std::string> kExtensionsToSkip = {"EXT_meshopt_compression",
                                                    "FB_ngon_encoding",
                                                    "EXT_texture_avif",
                                                    "EXT_texture_webp",
                                                    "KHR_draco_mesh_compression",
                                                    "KHR_meshopt_compression",
                                                    "KHR_texture_basisu",
                                                    "KHR_xmp",
                                                    "KHR_xmp_json_ld",
                                                    "MSFT_texture_dds"};

/// A scene without any light would be black: for `pbr` an environment stands in for it.
void add_default_light(Scene& scene) {
    const bool is_lit = std::ranges::any_of(scene.order, [&](std::size_t index) {
        const Overrides& overrides = scene.nodes[index].overrides;
        return scene.nodes[index].light || overrides.probe || overrides.reflection;
    });
    const bool is_lit_by_material = std::ranges::any_of(scene.materials, [](const Material& material) {
        return material.overrides.probe || material.overrides.reflection;
    });
    if (is_lit || is_lit_by_material || scene.ambient != glm::dvec3(0)) return;
    scene.has_no_light = true;
    if (!scene.is_physical) return;
    Probe probe;
    probe.kind = "image";
    for (const std::size_t index : scene.order) {
        scene.nodes[index].overrides.probe = probe;
        scene.nodes[index].overrides.reflection = 1;
    }
}

void read_asset(const Value& root) {
    const Value asset = root["asset"].object();
    if (!asset) asset.fail_with("a glTF file begins with {\"asset\": {\"version\": \"2.0\"}}", "is missing");
    std::string version;
    asset["version"].required().read(version);
    if (!version.starts_with("2.")) asset["version"].fail("is '{}', but only glTF 2 is read", version);
    std::string least = "2.0";
    asset["minVersion"].read(least);
    if (least != "2.0") asset["minVersion"].fail("is '{}', but only glTF 2.0 is read", least);
}

void check_extensions(const Value& root, Scene& scene) {
    std::vector<std::string> known = kKnownExtensions;
    if (scene.is_physical)
        for (std::string& name : read_material_extensions()) known.push_back(std::move(name));
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    for (const Value& value : root["extensionsRequired"].elements()) {
        std::string name;
        value.read(name);
        if (std::ranges::find(known, name) == known.end())
            value.fail_with(fmt::format("export without it; read are {}", join(known, ", ")),
                            "is {}, which gobo does not read", name);
    }
    known.insert(known.end(), kExtensionsToSkip.begin(), kExtensionsToSkip.end());
    for (const Value& value : root["extensionsUsed"].elements()) {
        std::string name;
        value.read(name);
        if (std::ranges::find(known, name) == known.end()) scene.not_read.push_back(std::move(name));
    }
}

constexpr double kRightAngle = std::numbers::pi / 2;
/// Angles are written in single precision as a rule: pi / 2 rounded up must pass.
constexpr double kAngleSlack = 1e-6;

void read_cone(const Value& value, Light& light, Diagnostics& warnings) {
    light.outer_angle = std::numbers::pi / 4;
    const Value cone = value["spot"];
    if (!cone)
        warnings.push_back(
            value.warning("is a spot light without 'spot'", "its cone reaches 45 degrees from its axis"));
    const Range angles{0, kRightAngle + kAngleSlack};
    cone["innerConeAngle"].read(light.inner_angle, angles);
    cone["outerConeAngle"].read(light.outer_angle, angles);
    light.outer_angle = std::min(light.outer_angle, kRightAngle);
    if (light.inner_angle > light.outer_angle + kAngleSlack)
        cone["innerConeAngle"].fail("is {:g}, wider than outerConeAngle, {:g}", light.inner_angle,
                                    light.outer_angle);
    if (light.inner_angle >= light.outer_angle)
        warnings.push_back(
            cone.warning(fmt::format("must have innerConeAngle, {:g}, below outerConeAngle, {:g}",
                                     light.inner_angle, light.outer_angle),
                         "its edge is hard"));
    light.inner_angle = std::min(light.inner_angle, light.outer_angle);
}

Light read_light(const Value& value, Diagnostics& warnings) {
    Light light;
    value["name"].read(light.name);
    light.kind = static_cast<LightKind>(value["type"].choice({kLightKinds.begin(), kLightKinds.end()}));
    value["color"].read_color(light.color);
    double intensity = 1;
    value["intensity"].read(intensity, kBrightness);
    light.color *= intensity;
    value["range"].read(light.range);
    if (light.range <= 0) value["range"].fail("is {:g}, but must be above 0", light.range);
    if (light.kind == LightKind::spot) read_cone(value, light, warnings);
    const Value extras = value.gobo_extras();
    extras.only({"attenuation", "exponent", "shadow"});
    extras["attenuation"].read_color(light.attenuation);
    extras["exponent"].read(light.exponent, {0, 1e6});
    extras["shadow"].read(light.casts_shadow);
    return light;
}

void read_perspective(const Value& view, Camera& camera) {
    view["yfov"].required().read(camera.vertical_angle);
    view["znear"].required().read(camera.near_plane);
    view["zfar"].read(camera.far_plane);
    view["aspectRatio"].read(camera.aspect);
    if (camera.vertical_angle <= 0 || camera.vertical_angle >= std::numbers::pi)
        view["yfov"].fail("is {:g}, but must be an angle between 0 and pi", camera.vertical_angle);
    if (camera.near_plane <= 0 || camera.far_plane <= camera.near_plane)
        view.fail("must have 0 < znear < zfar");
    if (camera.aspect && *camera.aspect <= 0) view["aspectRatio"].fail("must be above 0");
}

void read_orthographic(const Value& view, Camera& camera) {
    view["xmag"].required().read(camera.half_extent.x);
    view["ymag"].required().read(camera.half_extent.y);
    view["znear"].required().read(camera.near_plane);
    view["zfar"].required().read(camera.far_plane);
    if (camera.half_extent.x == 0 || camera.half_extent.y == 0)
        view.fail("must have xmag and ymag other than 0");
    if (camera.near_plane < 0 || camera.far_plane <= camera.near_plane)
        view.fail("must have 0 <= znear < zfar");
}

void read_cameras(const Value& root, Scene& scene) {
    for (const Value& value : root["cameras"].objects()) {
        Camera& camera = scene.cameras.emplace_back();
        value["name"].read(camera.name);
        camera.is_perspective = value["type"].choice({"perspective", "orthographic"}) == 0;
        const Value view = value[camera.is_perspective ? "perspective" : "orthographic"].required().object();
        if (camera.is_perspective)
            read_perspective(view, camera);
        else
            read_orthographic(view, camera);
    }
}

/// The roots that are drawn: those of the default scene, else of the first; all roots where there is no
/// scene.
std::vector<std::size_t> scene_roots(const Value& root, Scene& scene) {
    const std::vector<Value> scenes = root["scenes"].objects();
    const std::size_t chosen = root["scene"].index(scenes.size(), "scenes").value_or(0);
    std::vector<std::size_t> roots;
    if (scenes.empty()) {
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
            if (!scene.nodes[i].parent) roots.push_back(i);
        return roots;
    }
    const Value& value = scenes[chosen];
    roots = value["nodes"].indices(scene.nodes.size(), "nodes");
    const Value extras = value.gobo_extras();
    scene.overrides = read_overrides(extras, {"ambient", "background"});
    extras["ambient"].read_color(scene.ambient);
    if (glm::dvec3 color(0); extras["background"].read_color(color)) scene.background = color;
    for (std::size_t i = 0; i < roots.size(); ++i)
        if (const auto& parent = scene.nodes[roots[i]].parent)
            value[fmt::format("nodes[{}]", i)].fail_with("a scene lists root nodes only",
                                                         "is node {}, which is a child of node {}", roots[i],
                                                         *parent);
    return roots;
}

/// Far beyond any scene, but no sum or product of such numbers overflows.
constexpr double kFarthest = 1e30;

bool is_placed(const glm::dmat4& world) {
    const auto is_near = [](double number) { return std::abs(number) <= kFarthest; };
    return std::all_of(&world[0].x, &world[0].x + 16, is_near);
}

/// Marks what is in the scene, in order, with its place in the world and the overrides of the nodes above it.
void place_nodes(const Value& root, Scene& scene) {
    std::vector<std::size_t> open = scene_roots(root, scene);
    std::ranges::reverse(open);
    while (!open.empty()) {
        const std::size_t index = open.back();
        open.pop_back();
        Node& node = scene.nodes[index];
        if (node.in_scene) continue;  // listed twice
        node.in_scene = true;
        const Node* const parent = node.parent ? &scene.nodes[*node.parent] : nullptr;
        node.world = parent != nullptr ? parent->world * node.local : node.local;
        node.overrides.fill_from(parent != nullptr ? parent->overrides : scene.overrides);
        if (parent != nullptr && !parent->is_visible) node.is_visible = false;
        if (!node.is_visible) {  // cameras and joints stay
            node.mesh.reset();
            node.light.reset();
        }
        if (!is_placed(node.world))
            root[fmt::format("nodes[{}]", index)].fail("is transformed beyond {:g} units, or not finitely",
                                                       kFarthest);
        scene.order.push_back(index);
        open.insert(open.end(), node.children.rbegin(), node.children.rend());
    }
}

/// Each draw has an entry for each light: memory would end before the list does.
constexpr std::size_t kMostLightsOfDraws = 2'000'000;

Result<void> check_size(const Scene& scene) {
    std::size_t draws = 0;
    std::size_t lights = 0;
    for (const std::size_t index : scene.order) {
        const Node& node = scene.nodes[index];
        if (node.mesh) draws += scene.meshes[*node.mesh].primitives.size();
        if (node.light) ++lights;
    }
    if (lights == 0 || draws <= kMostLightsOfDraws / lights) return {};
    return fail(Place{scene.path}, {},
                fmt::format("has {} draws and {} lights, more than {} pairs of them", draws, lights,
                            kMostLightsOfDraws),
                "split the scene");
}

}  // namespace

Result<Scene> read_scene(const FileSystem& files, const std::string& path, Reading reading) {
    GOBO_TRY(const std::string content, files.read(path));
    Scene scene;
    scene.path = path;
    scene.files = {path};
    scene.is_physical = reading == Reading::physical;
    try {
        const Container container = open_container(content);
        const nlohmann::json document = parse_document(container.json);
        const Value root{&document, ""};
        read_asset(root);
        check_extensions(root, scene);
        const std::vector<std::string> buffers = read_buffers(files, root, container.binary, scene);
        Accessors accessors(root, buffers);
        for (const Value& light : root["extensions"]["KHR_lights_punctual"]["lights"].objects())
            scene.lights.push_back(read_light(light, scene.warnings));
        read_cameras(root, scene);
        read_materials(root, accessors, files, scene);
        read_meshes(root, accessors, scene);
        read_nodes(root, accessors, scene);
        place_nodes(root, scene);
        add_default_light(scene);
    } catch (Diagnostics& wrong) {
        if (wrong.front().place.file.empty()) wrong.front().place.file = path;
        return tl::unexpected(std::move(wrong));
    }
    for (Diagnostic& warning : scene.warnings) warning.place.file = path;
    GOBO_TRY_DO(check_size(scene));
    return scene;
}

}  // namespace gobo::scene
