// Nodes, and what moves them: skins, and animations as bounds, since no time is ever chosen.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// Deeper hierarchies are refused: whatever follows a node's ancestors stays quick.
constexpr int kDeepestHierarchy = 1024;
/// What all instances together may hold: drawing lays them out one by one.
constexpr std::size_t kMostInstancedVertices = 16'777'216;

/// Rotations are written with few digits as a rule: as much as a quaternion's length may differ from 1.
constexpr double kLengthSlack = 0.01;

const std::vector<Component> kSigned = {Component::float32, Component::int8, Component::int16};

void read_transform(const Value& value, Node& node) {
    if (const Value matrix = value["matrix"]) {
        node.has_matrix = matrix.read_numbers(&node.local[0].x, 16);
        if (glm::row(node.local, 3) != glm::dvec4(0, 0, 0, 1))
            matrix.fail("is not an affine transform: its last row must be 0 0 0 1");
        for (const char* name : {"translation", "rotation", "scale"})
            if (value[name]) value.fail("has both matrix and {}", name);
        return;
    }
    value["translation"].read(node.translation);
    value["scale"].read(node.scale);
    if (glm::dvec4 r(0); value["rotation"].read_numbers(&r.x, 4)) {
        const glm::dquat rotation(r.w, r.x, r.y, r.z);
        const double length = glm::length(rotation);
        if (std::abs(length - 1) > kLengthSlack)
            value["rotation"].fail("is not a rotation: its length must be 1");
        node.rotation = rotation / length;
    }
    node.local = glm::translate(glm::dmat4(1), node.translation) * glm::mat4_cast(node.rotation) *
                 glm::scale(glm::dmat4(1), node.scale);
}

/// EXT_mesh_gpu_instancing: a translation, a rotation and a scale for each instance, each optional.
std::vector<glm::dmat4> read_instances(const Value& attributes, Accessors& accessors) {
    Attributes reader{accessors, attributes, "instances"};
    const Values translation = reader.read("TRANSLATION", {{"VEC3"}, kSigned});
    const Values rotation = reader.read("ROTATION", {{"VEC4"}, kSigned});
    const Values scale = reader.read("SCALE", {{"VEC3"}, kSigned});
    std::vector<glm::dmat4> instances;
    for (std::size_t i = 0; i < reader.count; ++i) {
        glm::dmat4& instance = instances.emplace_back(1);
        if (translation.count > 0) instance = glm::translate(instance, translation.triple(i));
        if (rotation.count > 0) {
            const glm::dquat turn(rotation.at(i, 3), rotation.triple(i));
            const double length = glm::length(turn);
            if (!(length > 1e-6)) attributes["ROTATION"].fail("is not a rotation in element {}", i);
            instance *= glm::mat4_cast(turn / length);
        }
        if (scale.count > 0) instance = glm::scale(instance, scale.triple(i));
    }
    return instances;
}

void read_instancing(const Value& value, Accessors& accessors, const Scene& scene, Node& node) {
    if (!node.mesh) return;
    const Value extension = value["extensions"]["EXT_mesh_gpu_instancing"].object();
    if (!extension) return;
    if (node.skin)
        extension.fail_with("export each instance as a node of its own",
                            "stands beside a skin: gobo draws no skinned instances");
    node.instances = read_instances(extension["attributes"].required().object(), accessors);
    std::size_t vertices = 0;
    for (const Primitive& primitive : scene.meshes[*node.mesh].primitives)
        vertices += primitive.positions.size();
    if (node.instances.size() * vertices > kMostInstancedVertices)
        extension.fail("has {} instances of {} vertices, more than {} in all", node.instances.size(),
                       vertices, kMostInstancedVertices);
}

Node read_node(const Value& value, Accessors& accessors, std::size_t node_count, std::size_t skin_count,
               const Scene& scene) {
    Node node;
    value["name"].read(node.name);
    node.children = value["children"].indices(node_count, "nodes");
    node.mesh = value["mesh"].index(scene.meshes.size(), "meshes");
    node.skin = value["skin"].index(skin_count, "skins");
    node.camera = value["camera"].index(scene.cameras.size(), "cameras");
    if (const Value extension = value["extensions"]["KHR_lights_punctual"].object())
        node.light = extension["light"].required().index(scene.lights.size(), "lights");
    value["extensions"]["KHR_node_visibility"]["visible"].read(node.is_visible);
    read_transform(value, node);
    read_instancing(value, accessors, scene, node);
    node.overrides = read_overrides(value.gobo_extras());
    if (node.mesh && value["weights"]) {
        node.weights.resize(scene.meshes[*node.mesh].weights.size());
        value["weights"].read_numbers(node.weights.data(), node.weights.size());
    }
    return node;
}

void name_parents(const Value& root, std::vector<Node>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const std::size_t child : nodes[i].children) {
            auto& parent = nodes[child].parent;
            if (parent)
                root[fmt::format("nodes[{}]", child)].fail_with(
                    "a node has at most one parent; let two nodes share a mesh instead",
                    "is a child of both node {} and node {}", *parent, i);
            parent = i;
        }
    }
}

/// With one parent each, nodes form a cycle or hang too deep exactly where the way up is too long.
void check_depth(const Value& root, const std::vector<Node>& nodes) {
    std::optional<std::size_t> too_deep;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        int depth = 0;
        std::optional<std::size_t> above = nodes[i].parent;
        for (; above && above != i && depth <= kDeepestHierarchy; above = nodes[*above].parent) ++depth;
        if (above == i) root[fmt::format("nodes[{}]", i)].fail("is its own ancestor: the nodes form a cycle");
        if (depth > kDeepestHierarchy && !too_deep) too_deep = i;
    }
    if (too_deep)
        root[fmt::format("nodes[{}]", *too_deep)].fail("has more than {} nodes above it", kDeepestHierarchy);
}

/// Every joint that a skinned mesh names must be one of its skin's.
void check_influences(const Value& root, const Scene& scene) {
    std::vector<std::size_t> named(scene.meshes.size());  // one more than the greatest joint of each mesh
    for (std::size_t i = 0; i < named.size(); ++i)
        for (const Primitive& primitive : scene.meshes[i].primitives)
            for (const auto& influences : primitive.influences)
                for (const Influence& influence : influences)
                    named[i] = std::max(named[i], std::size_t{influence.joint} + 1);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!node.skin || !node.mesh) continue;
        const std::size_t joints = scene.skins[*node.skin].joints.size();
        const std::size_t count = named[*node.mesh];
        if (count > joints)
            root[fmt::format("meshes[{}]", *node.mesh)].fail(
                "names joint {}, but skins[{}] of nodes[{}] has {} joints", count - 1, *node.skin, i, joints);
    }
}

/// The hull of each of `width` numbers that a sampler gives at a time.
/// Between two keyframes a curve stays within the hull of its control points: the keyframes and, of a cubic
/// spline, the inner Bezier points p0 + m0 dt / 3 and p1 - m1 dt / 3 of each segment.
std::vector<Interval> read_hull(const Value& sampler, Accessors& accessors, const Wanted& wanted,
                                std::size_t width) {
    const bool is_cubic = sampler["interpolation"].choice({"LINEAR", "STEP", "CUBICSPLINE"}, 0) == 2;
    const Values times = accessors.read(sampler["input"].required(), {{"SCALAR"}, {Component::float32}});
    const Values values = accessors.read(sampler["output"].required(), wanted);
    const std::size_t expected = times.count * (is_cubic ? 3 : 1) * width / values.width;
    if (values.count != expected)
        sampler["output"].fail("has {} elements, but {} keyframes need {}", values.count, times.count,
                               expected);
    const auto fall = std::ranges::adjacent_find(times.numbers, std::greater_equal());
    if (fall != times.numbers.end())
        sampler["input"].fail("does not rise at keyframe {}", fall - times.numbers.begin() + 1);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<Interval> hull(width, {infinity, -infinity});
    for (std::size_t i = 0; i < times.count; ++i) {
        for (std::size_t part = 0; part < width; ++part) {
            // A cubic keyframe has three kinds of numbers: in-tangents, values, out-tangents.
            const auto number = [&](std::size_t keyframe, std::size_t kind) {
                return values.numbers[(is_cubic ? 3 * keyframe + kind : keyframe) * width + part];
            };
            hull[part].add(number(i, 1));
            if (!is_cubic || i + 1 == times.count) continue;
            const double third = (times.at(i + 1) - times.at(i)) / 3;
            hull[part].add(number(i, 1) + number(i, 2) * third);
            hull[part].add(number(i + 1, 1) - number(i + 1, 0) * third);
        }
    }
    return hull;
}

void read_weights(const Value& target, const Value& sampler, Accessors& accessors, const Scene& scene,
                  Node& node) {
    if (!node.mesh || scene.meshes[*node.mesh].weights.empty())
        target.fail("animates the weights of a node whose mesh has no morph targets");
    const std::vector<double>& rest = weights_at_rest(scene, node);
    const auto hull = read_hull(sampler, accessors, {{"SCALAR"}, kFloatOrSmall}, rest.size());
    std::vector<Interval>& weights = node.motion->weights;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (weights.size() == i) weights.push_back({rest[i], rest[i]});
        weights[i].add(hull[i].low);
        weights[i].add(hull[i].high);
    }
}

void read_channel(const Value& target, const Value& sampler, Accessors& accessors, Scene& scene) {
    std::string path;
    target["path"].required().read(path);
    const auto index = target["node"].index(scene.nodes.size(), "nodes");
    if (!index) return;  // without a node an extension animates something else
    Node& node = scene.nodes[*index];
    if (node.has_matrix && path != "weights") target.fail("animates nodes[{}], which has a matrix", *index);
    if (!node.motion)
        node.motion = Motion{{node.translation, node.translation}, {node.scale, node.scale}, {}, {}, {}};
    if (path == "translation" || path == "scale") {
        const auto hull = read_hull(sampler, accessors, {{"VEC3"}, {Component::float32}}, 3);
        Box& box = path == "scale" ? node.motion->scale : node.motion->translation;
        box.add(Box{{hull[0].low, hull[1].low, hull[2].low}, {hull[0].high, hull[1].high, hull[2].high}});
        node.motion->moves = true;
    } else if (path == "rotation") {
        static_cast<void>(read_hull(sampler, accessors, {{"VEC4"}, kFloatOrSmall}, 4));  // for its errors
        node.motion->rotates = node.motion->moves = true;
    } else if (path == "weights") {
        read_weights(target, sampler, accessors, scene, node);
    } else if (path != "pointer") {
        target["path"].fail_with("known: translation, rotation, scale, weights", "is '{}', which is unknown",
                                 path);
    }
}

void read_skins(const Value& root, Accessors& accessors, Scene& scene) {
    for (const Value& value : root["skins"].objects()) {
        Skin& skin = scene.skins.emplace_back();
        skin.joints = value["joints"].indices(scene.nodes.size(), "nodes");
        if (skin.joints.empty()) value["joints"].fail("must name at least one node");
        skin.inverse_bind.assign(skin.joints.size(), glm::dmat4(1));
        const Values values = accessors.read(value["inverseBindMatrices"], {{"MAT4"}, {Component::float32}});
        if (values.count > 0 && values.count < skin.joints.size())
            value["inverseBindMatrices"].fail("has {} matrices for {} joints", values.count,
                                              skin.joints.size());
        for (std::size_t i = 0; i < skin.joints.size() && values.count > 0; ++i)
            skin.inverse_bind[i] = glm::make_mat4(&values.numbers[16 * i]);
    }
    check_influences(root, scene);
}

void read_animations(const Value& root, Accessors& accessors, Scene& scene) {
    for (const Value& animation : root["animations"].objects()) {
        const std::vector<Value> samplers = animation["samplers"].objects();
        for (const Value& channel : animation["channels"].objects()) {
            const auto sampler = channel["sampler"].required().index(samplers.size(), "samplers");
            const Value target = channel["target"].required().object();
            read_channel(target, samplers[*sampler], accessors, scene);
        }
    }
}

}  // namespace

void read_nodes(const Value& root, Accessors& accessors, Scene& scene) {
    const std::vector<Value> values = root["nodes"].objects();
    const std::size_t skin_count = root["skins"].objects().size();
    for (const Value& value : values)
        scene.nodes.push_back(read_node(value, accessors, values.size(), skin_count, scene));
    name_parents(root, scene.nodes);
    check_depth(root, scene.nodes);
    read_skins(root, accessors, scene);
    read_animations(root, accessors, scene);
}

}  // namespace gobo::scene
