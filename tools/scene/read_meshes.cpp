#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/geometry.hpp"
#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

const Wanted kTriples = {{"VEC3"}, kFloatOrSmall};
const std::vector<Component> kUnsigned = {Component::float32, Component::uint8, Component::uint16};

/// glTF's modes: points, four kinds of lines, triangles, strips, fans.
constexpr int kTriangles = 4;
constexpr int kFan = 6;

/// Components that the file does not hold are 1: the alpha of colours.
template <class Vector>
std::vector<Vector> read_vectors(Attributes& attributes, std::string_view name, const Wanted& wanted) {
    const Values values = attributes.read(name, wanted);
    std::vector<Vector> vectors(values.count, Vector(1));
    for (std::size_t i = 0; i < values.numbers.size(); ++i)
        vectors[i / values.width][static_cast<glm::length_t>(i % values.width)] =
            static_cast<float>(values.numbers[i]);
    return vectors;
}

/// JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, ...
void read_influences(const Value& source, Attributes& attributes, Primitive& primitive) {
    for (int set = 0;; ++set) {
        const std::string weight_name = fmt::format("WEIGHTS_{}", set);
        const Values joints =
            attributes.read(fmt::format("JOINTS_{}", set), {{"VEC4"}, {Component::uint8, Component::uint16}});
        const Values weights = attributes.read(weight_name, {{"VEC4"}, kUnsigned});
        if (joints.count == 0 || weights.count == 0) return;
        primitive.influences.resize(primitive.positions.size());
        for (std::size_t i = 0; i < joints.count; ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                const double weight = weights.at(i, k);
                if (weight < 0) source[weight_name].fail("is negative in element {}", i);
                if (weight == 0) continue;
                primitive.influences[i].push_back(
                    {static_cast<std::uint32_t>(joints.at(i, k)), static_cast<float>(weight)});
            }
        }
    }
}

void read_indices(const Value& value, Accessors& accessors, Primitive& primitive) {
    const auto count = static_cast<double>(primitive.positions.size());
    const Values values = accessors.read(
        value["indices"], {{"SCALAR"}, {Component::uint8, Component::uint16, Component::uint32}});
    if (values.count == 0) {
        primitive.indices.resize(primitive.positions.size());
        std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    }
    for (std::size_t i = 0; i < values.count; ++i) {
        const double vertex = values.at(i);
        if (vertex >= count)
            value["indices"].fail("names vertex {} in element {}, but there are {}", vertex, i, count);
        primitive.indices.push_back(static_cast<std::uint32_t>(vertex));
    }
}

void read_targets(const Value& value, Accessors& accessors, Primitive& primitive) {
    for (const Value& target : value["targets"].objects()) {
        Attributes attributes{accessors, target, "positions", primitive.positions.size()};
        primitive.target_positions.push_back(read_vectors<glm::vec3>(attributes, "POSITION", kTriples));
        // Zero for a target of normals only.
        primitive.target_positions.back().resize(primitive.positions.size(), glm::vec3(0));
        for (const char* name : {"COLOR_0", "TEXCOORD_0", "TEXCOORD_1"})
            if (target[name]) primitive.targets_not_read.insert(name);
        // Without normals at rest there is nothing to add to: they are computed from what is morphed.
        if (!primitive.normals.empty())
            primitive.target_normals.push_back(read_vectors<glm::vec3>(attributes, "NORMAL", kTriples));
    }
}

/// The corners of a strip's or a fan's triangles, wound as glTF says (specification, 3.7.2.1). What does not
/// fill a triangle is left out.
std::vector<std::uint32_t> listed(const std::vector<std::uint32_t>& corners, int mode) {
    const std::size_t step = mode == kTriangles ? 3 : 1;
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
        const std::size_t odd =
            mode != kTriangles && mode != kFan ? i % 2 : 0;  // every other triangle of a strip turns
        triangles.insert(triangles.end(),
                         {corners[mode == kFan ? 0 : i], corners[i + 1 + odd], corners[i + 2 - odd]});
    }
    return triangles;
}

template <class T>
void spread(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> result;
    result.reserve(indices.size());
    for (const std::uint32_t index : indices) result.push_back(values[index]);
    values = std::move(result);
}

/// Gives every triangle vertices of its own, with its normal.
void spread_with_flat_normals(Primitive& primitive) {
    spread(primitive.positions, primitive.indices);
    spread(primitive.texcoords, primitive.indices);
    spread(primitive.colors, primitive.indices);
    spread(primitive.texcoords1, primitive.indices);
    primitive.tangents.clear();  // they belong to normals
    spread(primitive.influences, primitive.indices);
    for (auto& target : primitive.target_positions) spread(target, primitive.indices);
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    primitive.normals = flat_normals(primitive.positions);
    primitive.has_flat_normals = true;
}

/// The values of those vertices, in this order.
void take(Primitive& primitive, const std::vector<std::uint32_t>& vertices) {
    spread(primitive.positions, vertices);
    spread(primitive.normals, vertices);
    spread(primitive.texcoords, vertices);
    spread(primitive.texcoords1, vertices);
    spread(primitive.colors, vertices);
    spread(primitive.influences, vertices);
    for (auto& target : primitive.target_positions) spread(target, vertices);
    for (auto& target : primitive.target_normals) spread(target, vertices);
}

/// Of a triangle: along which its texture's u rises, and which way its v runs.
struct TextureSide {
    glm::dvec3 along_u{0};
    bool runs_down = false;  ///< v turns against u as on paper: the usual picture, whose v runs down
};

TextureSide side_of(const Primitive& primitive, const std::vector<glm::dvec2>& places, std::size_t first) {
    const auto edge = [&](std::size_t corner) {
        const std::uint32_t from = primitive.indices[first];
        const std::uint32_t to = primitive.indices[first + corner];
        return std::pair(glm::dvec3(primitive.positions[to]) - glm::dvec3(primitive.positions[from]),
                         places[to] - places[from]);
    };
    const auto [p1, t1] = edge(1);
    const auto [p2, t2] = edge(2);
    const double area = t1.x * t2.y - t1.y * t2.x;
    return {unit_or_zero((t2.y * p1 - t1.y * p2) * (area < 0 ? -1.0 : 1.0)), area < 0};
}

/// Tangents by the convention of MikkTSpace (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008, and
/// glTF 2.0, 3.7.2.1): at each vertex the directions in which u rises on its triangles, each in the plane of
/// the vertex' normal, their mean by the triangles' angles there; a vertex at which the texture is mirrored
/// on some of its triangles becomes two. The bitangent w (N x T) is where v falls: up, on a picture that is
/// not mirrored. The coordinates are those that the picture is looked up by.
void add_tangents(Primitive& primitive, const TextureUse& use) {
    std::vector<glm::dvec2> places;
    for (const glm::vec2& place : use.set == 1 ? primitive.texcoords1 : primitive.texcoords)
        places.push_back(use.placed(place));
    if (places.size() != primitive.positions.size() || primitive.normals.empty()) return;
    const std::size_t vertices = primitive.positions.size();
    std::vector<std::array<glm::dvec3, 2>> sums(vertices, {glm::dvec3(0), glm::dvec3(0)});
    std::vector<std::array<bool, 2>> is_used(vertices, {false, false});
    std::vector<bool> run_down(primitive.indices.size() / 3);
    for (std::size_t first = 0; first + 2 < primitive.indices.size(); first += 3) {
        const TextureSide side = side_of(primitive, places, first);
        run_down[first / 3] = side.runs_down;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto at = [&](std::size_t step) {
                return glm::dvec3(primitive.positions[primitive.indices[first + (corner + step) % 3]]);
            };
            const std::uint32_t vertex = primitive.indices[first + corner];
            const glm::dvec3 normal(primitive.normals[vertex]);
            const auto in_plane = [&](const glm::dvec3& vector) {
                return unit_or_zero(vector - glm::dot(normal, vector) * normal);
            };
            const double cosine = glm::dot(in_plane(at(1) - at(0)), in_plane(at(2) - at(0)));
            is_used[vertex][side.runs_down] = true;
            sums[vertex][side.runs_down] += std::acos(std::clamp(cosine, -1.0, 1.0)) * in_plane(side.along_u);
        }
    }
    std::vector<std::uint32_t> order(vertices);
    std::iota(order.begin(), order.end(), 0U);
    std::vector<std::uint32_t> other(
        vertices);  // where the half of a vertex lies on whose triangles v runs down
    std::vector<glm::dvec4> tangents(vertices);
    const auto tangent = [&](std::size_t vertex, bool runs_down) {
        return glm::dvec4(unit_or_zero(sums[vertex][runs_down]), runs_down ? 1 : -1);
    };
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        const bool runs_down = is_used[vertex][1] && !is_used[vertex][0];
        tangents[vertex] = tangent(vertex, runs_down);
        other[vertex] = static_cast<std::uint32_t>(vertex);
        if (!is_used[vertex][0] || !is_used[vertex][1]) continue;
        other[vertex] = static_cast<std::uint32_t>(order.size());
        order.push_back(static_cast<std::uint32_t>(vertex));
        tangents.push_back(tangent(vertex, true));
    }
    for (std::size_t i = 0; i < primitive.indices.size(); ++i)
        if (run_down[i / 3]) primitive.indices[i] = other[primitive.indices[i]];
    if (order.size() > vertices) take(primitive, order);
    for (const glm::dvec4& one : tangents) primitive.tangents.emplace_back(one);
}

/// Accessors without a buffer view are zeros, which a mesh that is compressed alone does not mean.
void refuse_draco_alone(const Value& primitive, const Value& attributes, const Accessors& accessors) {
    const Value draco = primitive["extensions"]["KHR_draco_mesh_compression"];
    if (draco && !accessors.has_view(attributes["POSITION"]))
        draco.fail_with("export the mesh uncompressed",
                        "holds what gobo does not read: the mesh is nowhere else");
}

Primitive read_primitive(const Value& value, Accessors& accessors, const Scene& scene) {
    Primitive primitive;
    const std::size_t default_material = scene.materials.size() - 1;
    primitive.material = value["material"].index(default_material, "materials").value_or(default_material);
    double mode = kTriangles;
    static_cast<void>(value["mode"].integer());
    value["mode"].read(mode, {0, kFan});
    if (mode < kTriangles) primitive.topology = mode == 0 ? Topology::points : Topology::lines;
    const Value source = value["attributes"].required().object();
    refuse_draco_alone(value, source, accessors);
    Attributes attributes{accessors, source, "positions"};
    primitive.positions = read_vectors<glm::vec3>(attributes, "POSITION", kTriples);
    if (primitive.positions.empty()) return primitive;  // allowed: something else supplies them
    primitive.normals = read_vectors<glm::vec3>(attributes, "NORMAL", kTriples);
    primitive.texcoords = read_vectors<glm::vec2>(attributes, "TEXCOORD_0", {{"VEC2"}, kFloatOrSmall});
    primitive.colors = read_vectors<glm::vec4>(attributes, "COLOR_0", {{"VEC3", "VEC4"}, kUnsigned});
    if (scene.is_physical) {
        primitive.texcoords1 = read_vectors<glm::vec2>(attributes, "TEXCOORD_1", {{"VEC2"}, kFloatOrSmall});
        primitive.tangents = read_vectors<glm::vec4>(attributes, "TANGENT", {{"VEC4"}, kFloatOrSmall});
    }
    read_influences(source, attributes, primitive);
    read_indices(value, accessors, primitive);
    read_targets(value, accessors, primitive);
    if (primitive.topology != Topology::triangles) return primitive;
    primitive.indices = listed(primitive.indices, static_cast<int>(mode));
    if (primitive.normals.empty() && !primitive.indices.empty()) spread_with_flat_normals(primitive);
    const auto& normals =
        scene.materials[primitive.material].physical.maps[static_cast<std::size_t>(MapKind::normal)];
    const bool is_brushed =
        scene.is_physical &&
        scene.materials[primitive.material].physical.of_extensions.at("Material.anisotropy").front() > 0;
    if ((normals || is_brushed) && primitive.tangents.empty())
        add_tangents(primitive, normals.value_or(TextureUse()));
    return primitive;
}

}  // namespace

std::vector<glm::vec3> flat_normals(const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> normals;
    normals.reserve(positions.size());
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
        const glm::dvec3 corner(positions[i]);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(positions[i + 1]) - corner, glm::dvec3(positions[i + 2]) - corner);
        normals.insert(normals.end(), 3, glm::vec3(unit_or_zero(normal)));
    }
    return normals;
}

void read_meshes(const Value& root, Accessors& accessors, Scene& scene) {
    for (const Value& value : root["meshes"].objects()) {
        Mesh mesh;
        value["name"].read(mesh.name);
        for (const Value& primitive : value["primitives"].objects())
            mesh.primitives.push_back(read_primitive(primitive, accessors, scene));
        if (mesh.primitives.empty()) value["primitives"].fail("must hold at least one primitive");
        const std::size_t targets = mesh.primitives.front().target_positions.size();
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i)
            if (const std::size_t count = mesh.primitives[i].target_positions.size(); count != targets)
                value[fmt::format("primitives[{}]", i)].fail(
                    "has {} morph targets, but the first primitive has {}", count, targets);
        mesh.weights.resize(targets);  // zero where it states none
        value["weights"].read_numbers(mesh.weights.data(), targets);
        scene.meshes.push_back(std::move(mesh));
    }
}

}  // namespace gobo::scene
