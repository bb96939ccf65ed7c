#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// Deeper hierarchies are refused: whatever follows a node's ancestors stays quick.
constexpr int deepest_hierarchy = 1024;

void read_matrix(Document& document, const Value& value, Node& node) {
    const auto numbers = document.numbers(value, "matrix", 16);
    if (!numbers) return;
    node.has_matrix = true;
    for (std::size_t i = 0; i < 16; ++i) {
        const auto column = static_cast<glm::length_t>(i / 4);
        node.local[column][static_cast<glm::length_t>(i % 4)] = (*numbers)[i];
    }
    const glm::dmat4& local = node.local;
    if (local[0][3] != 0 || local[1][3] != 0 || local[2][3] != 0 || local[3][3] != 1) {
        document.error(path_to(value, "matrix"), "is no affine transform: its last row must be 0 0 0 1");
    }
    for (const char* name : {"translation", "rotation", "scale"})
        if (value.json->contains(name))
            document.error(value.path, fmt::format("has both matrix and {}", name));
}

void read_transform(Document& document, const Value& value, Node& node) {
    if (value.json->contains("matrix")) return read_matrix(document, value, node);
    if (const auto t = document.numbers(value, "translation", 3))
        node.translation = {(*t)[0], (*t)[1], (*t)[2]};
    if (const auto s = document.numbers(value, "scale", 3)) node.scale = {(*s)[0], (*s)[1], (*s)[2]};
    if (const auto r = document.numbers(value, "rotation", 4)) {
        const glm::dquat rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
        const double length = glm::length(rotation);
        if (!(length > 1e-6 && length < 1e6)) {
            document.error(path_to(value, "rotation"), "is no rotation: its length must be 1");
            return;
        }
        node.rotation = rotation / length;
    }
    node.local = glm::translate(glm::dmat4(1), node.translation) * glm::mat4_cast(node.rotation) *
                 glm::scale(glm::dmat4(1), node.scale);
}

void read_light_index(Document& document, const Value& value, const Scene& scene, Node& node) {
    const auto extensions = document.object(value, "extensions");
    if (!extensions) return;
    const auto extension = document.object(*extensions, "KHR_lights_punctual");
    if (extension) node.light = document.required_index(*extension, "light", scene.lights.size(), "lights");
}

void read_node_extras(Document& document, const Value& value, Node& node) {
    const auto extras = gobo_extras(document, value);
    if (!extras) return;
    document.only(*extras, {"fog", "probe", "shadow", "specular", "toon"});
    node.wishes = read_wishes(document, *extras);
}

Node read_node(Document& document, const Value& value, std::size_t node_count, std::size_t skin_count,
               const Scene& scene) {
    Node node;
    node.name = document.string(value, "name").value_or("");
    node.children = document.indices(value, "children", node_count, "nodes");
    node.mesh = document.index(value, "mesh", scene.meshes.size(), "meshes");
    node.skin = document.index(value, "skin", skin_count, "skins");
    node.camera = document.index(value, "camera", scene.cameras.size(), "cameras");
    read_light_index(document, value, scene, node);
    read_transform(document, value, node);
    read_node_extras(document, value, node);
    if (node.mesh && value.json->contains("weights")) {
        const std::size_t targets = scene.meshes[static_cast<std::size_t>(*node.mesh)].weights.size();
        node.weights = document.numbers(value, "weights", targets).value_or(std::vector<double>());
    }
    return node;
}

void name_parents(Document& document, std::vector<Node>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            auto& parent = nodes[static_cast<std::size_t>(child)].parent;
            if (parent) {
                document.error(fmt::format("nodes[{}]", child),
                               fmt::format("is a child of both node {} and node {}", *parent, i),
                               "a node has at most one parent; let two nodes share a mesh instead");
                return;
            }
            parent = static_cast<int>(i);
        }
    }
}

/// With one parent each, nodes form a cycle or hang too deep exactly where the way up is too long.
void check_depth(Document& document, const std::vector<Node>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::optional<int> above = nodes[i].parent;
        for (int depth = 0; above; ++depth) {
            if (*above == static_cast<int>(i)) {
                document.error(fmt::format("nodes[{}]", i), "is its own ancestor: the nodes form a cycle");
                return;
            }
            if (depth > deepest_hierarchy) break;
            above = nodes[static_cast<std::size_t>(*above)].parent;
        }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::optional<int> above = nodes[i].parent;
        for (int depth = 1; above; ++depth, above = nodes[static_cast<std::size_t>(*above)].parent) {
            if (depth <= deepest_hierarchy) continue;
            document.error(fmt::format("nodes[{}]", i),
                           fmt::format("has more than {} nodes above it", deepest_hierarchy));
            return;
        }
    }
}

}  // namespace

void read_nodes(Document& document, Scene& scene) {
    const std::vector<Value> values = document.objects(document.root(), "nodes");
    const std::size_t skin_count = document.objects(document.root(), "skins").size();
    for (const Value& value : values) {
        scene.nodes.push_back(read_node(document, value, values.size(), skin_count, scene));
        if (document.failed()) return;
    }
    name_parents(document, scene.nodes);
    check_depth(document, scene.nodes);
}

}  // namespace gobo::scene
