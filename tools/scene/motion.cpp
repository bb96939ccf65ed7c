#include "scene/motion.hpp"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace gobo::scene {
namespace {

/// The animated transform of a node, applied to a box by interval arithmetic: scale, then any rotation at all
/// where it rotates, then translation.
Box moved(const Node& node, const Box& box) {
    const Motion& motion = *node.motion;
    Box result = product(motion.scale, box);
    result = motion.rotates ? rotated_anyhow(result) : transformed(glm::mat4_cast(node.rotation), result);
    return sum(motion.translation, result);
}

bool moves(const Node& node) {
    return node.motion && node.motion->moves;
}

/// The weights of a primitive's morph targets, at any time.
std::vector<Interval> weight_ranges(const Scene& scene, const Node& node, const Primitive& primitive) {
    if (node.motion && !node.motion->weights.empty()) return node.motion->weights;
    const std::vector<double>& rest =
        node.weights.empty() ? scene.meshes[static_cast<std::size_t>(*node.mesh)].weights : node.weights;
    std::vector<Interval> ranges;
    for (std::size_t i = 0; i < primitive.target_positions.size(); ++i) ranges.push_back({rest[i], rest[i]});
    return ranges;
}

/// Where a vertex may be once morphed.
Box vertex_box(const Primitive& primitive, const std::vector<Interval>& weights, std::size_t vertex) {
    const glm::dvec3 position(primitive.positions[vertex]);
    Box box{position, position};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const glm::dvec3 shift(primitive.target_positions[i][vertex]);
        Box shifts;
        shifts.add(shift * weights[i].low);
        shifts.add(shift * weights[i].high);
        box = sum(box, shifts);
    }
    return box;
}

/// Around all instances, in the node's space.
Box around_instances(const Node& node, const Box& box) {
    Box result;
    for (const glm::dmat4& instance : node.instances) result.add(transformed(instance, box));
    return result;
}

/// A skinned vertex is a mean of where its joints take it, so it lies within the box of these places. The
/// node's own transform does not count (glTF 2.0 specification, 3.7.3.1).
std::optional<Box> skinned_bounds(const Scene& scene, const Node& node, const Primitive& primitive,
                                  const std::vector<Interval>& weights) {
    const Skin& skin = scene.skins[static_cast<std::size_t>(*node.skin)];
    if (primitive.influences.empty()) return std::nullopt;
    std::vector<Box> by_joint(skin.joints.size());
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        if (primitive.influences[i].empty()) return std::nullopt;
        const Box box = vertex_box(primitive, weights, i);
        for (const Influence& influence : primitive.influences[i]) by_joint[influence.joint].add(box);
    }
    Box result;
    for (std::size_t i = 0; i < by_joint.size(); ++i) {
        if (by_joint[i].is_empty()) continue;
        result.add(world_box(scene, skin.joints[i], transformed(skin.inverse_bind[i], by_joint[i])));
    }
    return result;
}

}  // namespace

bool is_moving(const Scene& scene, int node) {
    for (std::optional<int> at = node; at; at = scene.nodes[static_cast<std::size_t>(*at)].parent)
        if (moves(scene.nodes[static_cast<std::size_t>(*at)])) return true;
    return false;
}

Box world_box(const Scene& scene, int node, const Box& box) {
    Box result = box;
    glm::dmat4 still(1);  // of the nodes since the last one that moves: applied together, it loses nothing
    for (std::optional<int> at = node; at; at = scene.nodes[static_cast<std::size_t>(*at)].parent) {
        const Node& here = scene.nodes[static_cast<std::size_t>(*at)];
        if (moves(here)) {
            result = moved(here, transformed(still, result));
            still = glm::dmat4(1);
        } else {
            still = here.local * still;
        }
    }
    return transformed(still, result);
}

std::optional<Box> world_bounds(const Scene& scene, int node, const Primitive& primitive) {
    const Node& here = scene.nodes[static_cast<std::size_t>(node)];
    const std::vector<Interval> weights = weight_ranges(scene, here, primitive);
    if (here.skin) return skinned_bounds(scene, here, primitive, weights);
    const bool is_still = !is_moving(scene, node);
    const bool is_instanced = !here.instances.empty();
    Box box;
    if (is_still && weights.empty() && !is_instanced) {
        for (const glm::vec3& position : primitive.positions)
            box.add(glm::dvec3(here.world * glm::dvec4(position, 1)));
        return box;
    }
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const Box vertex = vertex_box(primitive, weights, i);
        box.add(is_still && !is_instanced ? transformed(here.world, vertex) : vertex);
    }
    if (is_instanced) return world_box(scene, node, around_instances(here, box));
    return is_still ? box : world_box(scene, node, box);
}

}  // namespace gobo::scene
