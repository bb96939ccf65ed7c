#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gobo::scene {
namespace {

/// Projections converge within a handful of steps unless the two nearly touch, where nothing is dropped
/// anyway.
constexpr int kMostSteps = 64;

bool moves(const Node& node) {
    return node.motion && node.motion->moves;
}

/// The animated transform of a node, applied to a box: scale, then any rotation at all about the origin where
/// it rotates, then translation.
Box moved(const Node& node, const Box& box) {
    const Motion& motion = *node.motion;
    Box result = product(motion.scale, box);
    if (result.is_empty()) return result;
    if (motion.rotates) {
        const double radius = glm::length(glm::max(glm::abs(result.low), glm::abs(result.high)));
        result = {glm::dvec3(-radius), glm::dvec3(radius)};
    } else {
        result = transformed(glm::mat4_cast(node.rotation), result);
    }
    return sum(motion.translation, result);
}

/// The weights of a primitive's morph targets, at any time.
std::vector<Interval> weight_ranges(const Scene& scene, const Node& node, const Primitive& primitive) {
    if (node.motion && !node.motion->weights.empty()) return node.motion->weights;
    const std::vector<double>& rest = weights_at_rest(scene, node);
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

/// A skinned vertex is a mean of where its joints take it, so it lies within the box of these places. The
/// node's own transform does not count (glTF 2.0 specification, 3.7.3.1).
std::optional<Box> skinned_bounds(const Scene& scene, const Skin& skin, const Primitive& primitive,
                                  const std::vector<Interval>& weights) {
    if (primitive.influences.empty()) return std::nullopt;
    std::vector<Box> by_joint(skin.joints.size());
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        if (primitive.influences[i].empty()) return std::nullopt;
        const Box box = vertex_box(primitive, weights, i);
        for (const Influence& influence : primitive.influences[i]) by_joint[influence.joint].add(box);
    }
    Box result;
    for (std::size_t i = 0; i < by_joint.size(); ++i)
        if (!by_joint[i].is_empty())
            result.add(world_box(scene, skin.joints[i], transformed(skin.inverse_bind[i], by_joint[i])));
    return result;
}

}  // namespace

void Box::add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

glm::dvec3 Box::corner(int index) const {
    return {(index & 1) != 0 ? high.x : low.x, (index & 2) != 0 ? high.y : low.y,
            (index & 4) != 0 ? high.z : low.z};
}

glm::dvec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? vector / length : glm::dvec3(0);
}

Box transformed(const glm::dmat4& matrix, const Box& box) {
    Box result;
    if (box.is_empty()) return result;
    const int corners = box.low == box.high ? 1 : 8;
    for (int i = 0; i < corners; ++i) result.add(glm::dvec3(matrix * glm::dvec4(box.corner(i), 1)));
    return result;
}

Box product(const Box& a, const Box& b) {
    Box result;
    if (a.is_empty() || b.is_empty()) return result;
    for (const glm::dvec3& left : {a.low, a.high})
        for (const glm::dvec3& right : {b.low, b.high}) result.add(left * right);
    return result;
}

Box sum(const Box& a, const Box& b) {
    return a.is_empty() || b.is_empty() ? Box() : Box{a.low + b.low, a.high + b.high};
}

Interval extent_of(const Box& box, const glm::dvec3& direction) {
    const double first = glm::dot(direction, box.corner(0));
    Interval extent{first, first};
    for (int i = 1; i < 8; ++i) extent.add(glm::dot(direction, box.corner(i)));
    return extent;
}

double least_distance(const Box& a, const Box& b) {
    return glm::length(glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0)));
}

double greatest_distance(const Box& a, const Box& b) {
    return glm::length(glm::max(glm::abs(a.high - b.low), glm::abs(b.high - a.low)));
}

/// The nearest point of a cone cut by a ball about its apex is the ball's nearest point to the cone's
/// (Bauschke, Bui and Wang: Projecting onto the intersection of a cone and a sphere, SIAM J. Optim. 28,
/// 2018).
glm::dvec3 LitVolume::nearest_to(const glm::dvec3& point) const {
    const double along = glm::dot(point - apex, axis);
    const glm::dvec3 across = point - apex - along * axis;
    const double away = glm::length(across);
    const double cosine = std::cos(half_angle);
    const double sine = std::sin(half_angle);
    glm::dvec3 near = point - apex;  // of the infinite cone, relative to the apex
    if (away * cosine > along * sine) {
        const double on_edge = along * cosine + away * sine;  // how far along the cone's edge it lies
        near = on_edge > 0 ? on_edge * (cosine * axis + sine * (across / away)) : glm::dvec3(0);
    }
    const double distance = glm::length(near);
    return apex + (distance > radius ? near * (radius / distance) : near);
}

double proven_gap(const LitVolume& volume, const Box& box) {
    double gap = 0;
    glm::dvec3 in_box = glm::clamp(volume.apex, box.low, box.high);
    for (int step = 0; step < kMostSteps; ++step) {
        const glm::dvec3 in_volume = volume.nearest_to(in_box);
        const glm::dvec3 apart = in_box - in_volume;
        const double distance = glm::length(apart);
        if (distance == 0) return 0;
        const glm::dvec3 normal = apart / distance;
        // The volume lies on the near side of the plane through in_volume, as that is its point nearest to
        // in_box.
        gap = std::max(gap, extent_of(box, normal).low - glm::dot(normal, in_volume));
        const glm::dvec3 next = glm::clamp(in_volume, box.low, box.high);
        if (glm::length(next - in_box) <= 1e-12 * distance) break;
        in_box = next;
    }
    return gap;
}

bool is_moving(const Scene& scene, std::size_t node) {
    for (std::optional<std::size_t> at = node; at; at = scene.nodes[*at].parent)
        if (moves(scene.nodes[*at])) return true;
    return false;
}

Box world_box(const Scene& scene, std::size_t node, const Box& box) {
    Box result = box;
    glm::dmat4 still(1);  // of the nodes since the last one that moves: applied together, it loses nothing
    for (std::optional<std::size_t> at = node; at; at = scene.nodes[*at].parent) {
        const Node& here = scene.nodes[*at];
        if (moves(here)) {
            result = moved(here, transformed(still, result));
            still = glm::dmat4(1);
        } else {
            still = here.local * still;
        }
    }
    return transformed(still, result);
}

std::optional<Box> world_bounds(const Scene& scene, std::size_t node, const Primitive& primitive) {
    const Node& here = scene.nodes[node];
    const std::vector<Interval> weights = weight_ranges(scene, here, primitive);
    if (here.skin) return skinned_bounds(scene, scene.skins[*here.skin], primitive, weights);
    // Vertices are taken to world space one by one where that is exact, else the box of all.
    const bool is_direct = here.instances.empty() && !is_moving(scene, node);
    Box box;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const Box vertex = vertex_box(primitive, weights, i);
        box.add(is_direct ? transformed(here.world, vertex) : vertex);
    }
    if (is_direct) return box;
    if (here.instances.empty()) return world_box(scene, node, box);
    Box around_instances;
    for (const glm::dmat4& instance : here.instances) around_instances.add(transformed(instance, box));
    return world_box(scene, node, around_instances);
}

}  // namespace gobo::scene
