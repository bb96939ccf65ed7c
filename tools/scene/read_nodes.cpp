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
    node.overrides = read_overrides(document, *extras, {});
}

/// EXT_mesh_gpu_instancing: a translation, a rotation and a scale for each instance, each optional.
class InstanceReader {
  public:
    InstanceReader(Document& document, Accessors& accessors, Value attributes)
        : document_(document), accessors_(accessors), attributes_(std::move(attributes)) {}

    std::vector<glm::dmat4> read() {
        const Values translation = column("TRANSLATION", "VEC3");
        const Values rotation = column("ROTATION", "VEC4");
        const Values scale = column("SCALE", "VEC3");
        std::vector<glm::dmat4> instances;
        for (std::size_t i = 0; i < count_ && !document_.failed(); ++i) {
            glm::dmat4 instance(1);
            if (translation.count > 0) instance = glm::translate(instance, triple(translation, i));
            if (rotation.count > 0) instance *= glm::mat4_cast(quaternion(rotation, i));
            if (scale.count > 0) instance = glm::scale(instance, triple(scale, i));
            instances.push_back(instance);
        }
        return instances;
    }

  private:
    Values column(const char* name, std::string_view shape) {
        const auto index = document_.index(attributes_, name, accessors_.size(), "accessors");
        if (!index) return {};
        const std::string user = path_to(attributes_, name);
        Values values = accessors_.read(
            *index, {{shape}, {Component::float_number, Component::signed_byte, Component::signed_short}},
            user);
        if (count_ == 0) count_ = values.count;
        if (!document_.failed() && values.count != count_)
            document_.error(user,
                            fmt::format("has {} elements, but there are {} instances", values.count, count_));
        return values;
    }
    static glm::dvec3 triple(const Values& values, std::size_t i) {
        return {values.at(i, 0), values.at(i, 1), values.at(i, 2)};
    }
    glm::dquat quaternion(const Values& values, std::size_t i) {
        const glm::dquat rotation(values.at(i, 3), values.at(i, 0), values.at(i, 1), values.at(i, 2));
        const double length = glm::length(rotation);
        if (length > 1e-6) return rotation / length;
        document_.error(path_to(attributes_, "ROTATION"), fmt::format("is no rotation in element {}", i));
        return {1, 0, 0, 0};
    }

    Document& document_;
    Accessors& accessors_;
    Value attributes_;
    std::size_t count_ = 0;
};

/// What all instances together may hold: drawing lays them out one by one.
constexpr std::size_t most_instanced_vertices = 16'777'216;

void read_instances(Document& document, Accessors& accessors, const Value& value, const Scene& scene,
                    Node& node) {
    const auto extensions = document.object(value, "extensions");
    if (!extensions || !node.mesh) return;
    const auto extension = document.object(*extensions, "EXT_mesh_gpu_instancing");
    if (!extension) return;
    if (node.skin) {
        document.error(extension->path, "stands beside a skin: gobo draws no skinned instances",
                       "export each instance as a node of its own");
        return;
    }
    const auto attributes = document.object(*extension, "attributes");
    if (!attributes) {
        document.error(path_to(*extension, "attributes"), "is missing");
        return;
    }
    node.instances = InstanceReader(document, accessors, *attributes).read();
    std::size_t vertices = 0;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(*node.mesh)].primitives)
        vertices += primitive.positions.size();
    if (node.instances.size() * vertices > most_instanced_vertices)
        document.error(extension->path,
                       fmt::format("calls for {} instances of {} vertices, more than {} in all",
                                   node.instances.size(), vertices, most_instanced_vertices));
}

Node read_node(Document& document, Accessors& accessors, const Value& value, std::size_t node_count,
               std::size_t skin_count, const Scene& scene) {
    Node node;
    node.name = document.string(value, "name").value_or("");
    node.children = document.indices(value, "children", node_count, "nodes");
    node.mesh = document.index(value, "mesh", scene.meshes.size(), "meshes");
    node.skin = document.index(value, "skin", skin_count, "skins");
    node.camera = document.index(value, "camera", scene.cameras.size(), "cameras");
    read_light_index(document, value, scene, node);
    read_transform(document, value, node);
    read_instances(document, accessors, value, scene, node);
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

void read_nodes(Document& document, Accessors& accessors, Scene& scene) {
    const std::vector<Value> values = document.objects(document.root(), "nodes");
    const std::size_t skin_count = document.objects(document.root(), "skins").size();
    for (const Value& value : values) {
        scene.nodes.push_back(read_node(document, accessors, value, values.size(), skin_count, scene));
        if (document.failed()) return;
    }
    name_parents(document, scene.nodes);
    check_depth(document, scene.nodes);
}

}  // namespace gobo::scene
