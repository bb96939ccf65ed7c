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
    spread(primitive.influences, primitive.indices);
    for (auto& target : primitive.target_positions) spread(target, primitive.indices);
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    primitive.normals = flat_normals(primitive.positions);
    primitive.has_flat_normals = true;
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
    Attributes attributes{accessors, source, "positions"};
    primitive.positions = read_vectors<glm::vec3>(attributes, "POSITION", kTriples);
    if (primitive.positions.empty()) return primitive;  // allowed: something else supplies them
    primitive.normals = read_vectors<glm::vec3>(attributes, "NORMAL", kTriples);
    primitive.texcoords = read_vectors<glm::vec2>(attributes, "TEXCOORD_0", {{"VEC2"}, kFloatOrSmall});
    primitive.colors = read_vectors<glm::vec4>(attributes, "COLOR_0", {{"VEC3", "VEC4"}, kUnsigned});
    read_influences(source, attributes, primitive);
    read_indices(value, accessors, primitive);
    read_targets(value, accessors, primitive);
    if (primitive.topology != Topology::triangles) return primitive;
    primitive.indices = listed(primitive.indices, static_cast<int>(mode));
    if (primitive.normals.empty() && !primitive.indices.empty()) spread_with_flat_normals(primitive);
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
