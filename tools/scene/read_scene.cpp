#include "scene/read_scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.hpp"
#include "scene/buffers.hpp"
#include "scene/container.hpp"
#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// What the file may require. A transform of textures is of no concern: colours are not sampled, and what is
/// cut by a transformed picture is taken to be cut anywhere.
const std::vector<std::string> known_extensions = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_materials_specular",  "KHR_materials_unlit", "KHR_mesh_quantization",
    "KHR_texture_transform"};

void read_asset(Document& document) {
    const auto asset = document.object(document.root(), "asset");
    if (!asset) {
        document.error("asset", "is missing", "a glTF file begins with {\"asset\": {\"version\": \"2.0\"}}");
        return;
    }
    const auto version = document.string(*asset, "version");
    if (!version) document.error("asset.version", "is missing");
    if (version && !version->starts_with("2.")) {
        document.error("asset.version", fmt::format("is '{}', but only glTF 2 is read", *version));
    }
    const auto least = document.string(*asset, "minVersion");
    if (least && *least != "2.0") {
        document.error("asset.minVersion", fmt::format("is '{}', but only glTF 2.0 is read", *least));
    }
}

void check_extensions(Document& document) {
    for (const Value& value : document.elements(document.root(), "extensionsRequired")) {
        if (!value.json->is_string()) {
            document.error(value.path, "must be a string");
            return;
        }
        const auto name = value.json->get<std::string>();
        if (std::find(known_extensions.begin(), known_extensions.end(), name) != known_extensions.end())
            continue;
        document.error(value.path, fmt::format("is {}, which gobo does not read", name),
                       fmt::format("export without it; read are {}", join(known_extensions, ", ")));
    }
}

void read_scene_extras(Document& document, const Value& object, Scene& scene) {
    const auto extras = gobo_extras(document, object);
    if (!extras) return;
    scene.overrides = read_overrides(document, *extras, {"ambient", "background"});
    scene.ambient = read_color(document, *extras, "ambient").value_or(glm::dvec3(0));
    scene.background = read_color(document, *extras, "background");
}

/// The roots that are drawn: those of the default scene, else of the first; all roots where there is no
/// scene.
std::vector<int> scene_roots(Document& document, Scene& scene) {
    const std::vector<Value> scenes = document.objects(document.root(), "scenes");
    const int chosen = document.index(document.root(), "scene", scenes.size(), "scenes").value_or(0);
    std::vector<int> roots;
    if (scenes.empty()) {
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
            if (!scene.nodes[i].parent) roots.push_back(static_cast<int>(i));
        return roots;
    }
    const Value& value = scenes[static_cast<std::size_t>(chosen)];
    roots = document.indices(value, "nodes", scene.nodes.size(), "nodes");
    read_scene_extras(document, value, scene);
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const auto& parent = scene.nodes[static_cast<std::size_t>(roots[i])].parent;
        if (!parent) continue;
        document.error(fmt::format("{}.nodes[{}]", value.path, i),
                       fmt::format("is node {}, which is a child of node {}", roots[i], *parent),
                       "a scene lists root nodes only");
    }
    return roots;
}

/// Far beyond any scene, but no sum or product of such numbers overflows.
constexpr double farthest = 1e30;

void check_place(Document& document, int index, const Node& node) {
    for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 3; ++row) {
            if (std::abs(node.world[column][row]) <= farthest) continue;
            document.error(fmt::format("nodes[{}]", index),
                           fmt::format("is transformed beyond {:g} units, or not finitely", farthest));
        }
    }
}

/// Marks what is in the scene, in order, with its place in the world and the overrides of the nodes above it.
void place_nodes(Document& document, Scene& scene) {
    std::vector<int> open = scene_roots(document, scene);
    if (document.failed()) return;
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        const int index = open.back();
        open.pop_back();
        Node& node = scene.nodes[static_cast<std::size_t>(index)];
        if (node.in_scene) continue;  // listed twice
        node.in_scene = true;
        node.world = node.local;
        if (node.parent) {
            const Node& parent = scene.nodes[static_cast<std::size_t>(*node.parent)];
            node.world = parent.world * node.local;
            node.overrides.fill_from(parent.overrides);
        } else {
            node.overrides.fill_from(scene.overrides);
        }
        check_place(document, index, node);
        scene.order.push_back(index);
        open.insert(open.end(), node.children.rbegin(), node.children.rend());
    }
}

}  // namespace

Result<Scene> read_scene(const FileSystem& files, const std::string& path) {
    const Result<std::string> content = files.read(path);
    if (!content) return tl::unexpected(content.error());
    const Result<Container> container = open_container(*content, path);
    if (!container) return tl::unexpected(container.error());
    Document document(container->json, path);
    read_asset(document);
    check_extensions(document);
    const Buffers buffers = read_buffers(files, document, container->binary);
    Accessors accessors(document, buffers);
    Scene scene;
    scene.path = path;
    scene.files = {path};
    scene.files.insert(scene.files.end(), buffers.files.begin(), buffers.files.end());
    Textures textures(document, accessors, files);
    read_lights(document, scene);
    read_cameras(document, scene);
    read_materials(document, textures, scene);
    scene.files.insert(scene.files.end(), textures.files().begin(), textures.files().end());
    read_meshes(document, accessors, scene);
    read_nodes(document, accessors, scene);
    read_skins(document, accessors, scene);
    read_animations(document, accessors, scene);
    place_nodes(document, scene);
    if (document.failed()) return tl::unexpected(document.errors());
    return scene;
}

}  // namespace gobo::scene
