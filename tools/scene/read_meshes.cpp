#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// KHR_mesh_quantization allows small whole numbers where glTF wants floats.
const std::vector<Component> float_or_quantized = {Component::float_number, Component::signed_byte,
                                                   Component::unsigned_byte, Component::signed_short,
                                                   Component::unsigned_short};
const std::vector<Component> float_or_normalized = {Component::float_number, Component::unsigned_byte,
                                                    Component::unsigned_short};
const std::vector<Component> whole_numbers = {Component::unsigned_byte, Component::unsigned_short,
                                              Component::unsigned_int};

/// Reads the attributes of one primitive: each must have as many elements as there are positions.
class AttributeReader {
  public:
    AttributeReader(Document& document, Accessors& accessors, Value attributes)
        : document_(document), accessors_(accessors), attributes_(std::move(attributes)) {}

    /// The values, or none where the primitive has no such attribute.
    std::optional<Values> read(std::string_view name, const Wanted& wanted) {
        const auto index = document_.index(attributes_, name, accessors_.size(), "accessors");
        if (!index) return std::nullopt;
        const std::string user = path_to(attributes_, name);
        Values values = accessors_.read(*index, wanted, user);
        if (document_.failed()) return std::nullopt;
        if (count_ == 0) count_ = values.count;
        if (values.count == count_) return values;
        document_.error(user,
                        fmt::format("has {} elements, but there are {} positions", values.count, count_));
        return std::nullopt;
    }

    std::vector<glm::vec3> triples(std::string_view name) {
        std::vector<glm::vec3> result;
        const auto values = read(name, {{"VEC3"}, float_or_quantized});
        for (std::size_t i = 0; values && i < values->count; ++i)
            result.emplace_back(values->at(i, 0), values->at(i, 1), values->at(i, 2));
        return result;
    }

    /// For the attributes of morph targets: the count is that of the primitive.
    void expect_count(std::size_t count) { count_ = count; }

  private:
    Document& document_;
    Accessors& accessors_;
    Value attributes_;
    std::size_t count_ = 0;
};

void read_colors(AttributeReader& attributes, Primitive& primitive) {
    const auto values = attributes.read("COLOR_0", {{"VEC3", "VEC4"}, float_or_normalized});
    for (std::size_t i = 0; values && i < values->count; ++i) {
        const double alpha = values->width == 4 ? values->at(i, 3) : 1;
        primitive.colors.emplace_back(values->at(i, 0), values->at(i, 1), values->at(i, 2), alpha);
    }
}

void read_texcoords(AttributeReader& attributes, Primitive& primitive) {
    const auto values = attributes.read("TEXCOORD_0", {{"VEC2"}, float_or_quantized});
    for (std::size_t i = 0; values && i < values->count; ++i)
        primitive.texcoords.emplace_back(values->at(i, 0), values->at(i, 1));
}

/// JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, ...
void read_influences(Document& document, const Value& source, AttributeReader& attributes,
                     Primitive& primitive) {
    for (int set = 0;; ++set) {
        const std::string weight_name = fmt::format("WEIGHTS_{}", set);
        const auto joints = attributes.read(
            fmt::format("JOINTS_{}", set), {{"VEC4"}, {Component::unsigned_byte, Component::unsigned_short}});
        const auto weights = attributes.read(weight_name, {{"VEC4"}, float_or_normalized});
        if (!joints || !weights) return;
        primitive.influences.resize(primitive.positions.size());
        for (std::size_t i = 0; i < joints->count; ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                const double weight = weights->at(i, k);
                if (weight < 0) {
                    document.error(path_to(source, weight_name), fmt::format("is negative in element {}", i));
                    return;
                }
                if (weight == 0) continue;
                primitive.influences[i].push_back(
                    {static_cast<std::uint32_t>(joints->at(i, k)), static_cast<float>(weight)});
            }
        }
    }
}

void read_indices(Document& document, Accessors& accessors, const Value& value, Primitive& primitive) {
    const auto index = document.index(value, "indices", accessors.size(), "accessors");
    if (!index) {
        primitive.indices.resize(primitive.positions.size());
        std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
        return;
    }
    const std::string user = path_to(value, "indices");
    const Values values = accessors.read(*index, {{"SCALAR"}, whole_numbers}, user);
    const auto count = static_cast<double>(primitive.positions.size());
    primitive.indices.reserve(values.count);
    for (std::size_t i = 0; i < values.count; ++i) {
        const double vertex = values.at(i, 0);
        if (vertex >= count) {
            document.error(user,
                           fmt::format("names vertex {} in element {}, but there are {}", vertex, i, count));
            return;
        }
        primitive.indices.push_back(static_cast<std::uint32_t>(vertex));
    }
}

void read_targets(Document& document, Accessors& accessors, const Value& value, Primitive& primitive) {
    for (const Value& target : document.objects(value, "targets")) {
        AttributeReader attributes(document, accessors, target);
        attributes.expect_count(primitive.positions.size());
        primitive.target_positions.push_back(attributes.triples("POSITION"));
        if (primitive.target_positions.back().empty())  // a target of normals only
            primitive.target_positions.back().assign(primitive.positions.size(), glm::vec3(0));
        // Without normals at rest there is nothing to add to: they are computed from what is morphed.
        if (primitive.normals.empty()) continue;
        primitive.target_normals.push_back(attributes.triples("NORMAL"));
        if (document.failed()) return;
    }
}

int read_mode(Document& document, const Value& value, Primitive& primitive) {
    const auto mode = static_cast<int>(document.integer(value, "mode").value_or(4));
    if (!document.number_within(value, "mode", 0, 6)) return 4;  // triangles, too, where it is absent
    if (mode == 0) primitive.topology = Topology::points;
    if (mode >= 1 && mode <= 3) primitive.topology = Topology::lines;
    return mode;
}

Primitive read_primitive(Document& document, Accessors& accessors, const Value& value, const Scene& scene) {
    Primitive primitive;
    const int default_material = static_cast<int>(scene.materials.size()) - 1;
    primitive.material =
        document.index(value, "material", scene.materials.size() - 1, "materials").value_or(default_material);
    const int mode = read_mode(document, value, primitive);
    const auto source = document.object(value, "attributes");
    if (!source) {
        document.error(path_to(value, "attributes"), "is missing");
        return primitive;
    }
    AttributeReader attributes(document, accessors, *source);
    primitive.positions = attributes.triples("POSITION");
    if (primitive.positions.empty()) return primitive;  // allowed: something else supplies them
    primitive.normals = attributes.triples("NORMAL");
    read_texcoords(attributes, primitive);
    read_colors(attributes, primitive);
    read_influences(document, *source, attributes, primitive);
    read_indices(document, accessors, value, primitive);
    read_targets(document, accessors, value, primitive);
    if (!document.failed() && primitive.topology == Topology::triangles) finish_triangles(primitive, mode);
    return primitive;
}

/// The weights of a mesh, one per morph target; zero where it states none.
void read_weights(Document& document, const Value& value, Mesh& mesh) {
    const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().target_positions.size();
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const std::size_t count = mesh.primitives[i].target_positions.size();
        if (count == targets) continue;
        document.error(fmt::format("{}.primitives[{}]", value.path, i),
                       fmt::format("has {} morph targets, but the first primitive has {}", count, targets));
    }
    mesh.weights = document.numbers(value, "weights", targets).value_or(std::vector<double>(targets, 0.0));
}

}  // namespace

void read_meshes(Document& document, Accessors& accessors, Scene& scene) {
    for (const Value& value : document.objects(document.root(), "meshes")) {
        Mesh mesh;
        mesh.name = document.string(value, "name").value_or("");
        for (const Value& primitive : document.objects(value, "primitives")) {
            mesh.primitives.push_back(read_primitive(document, accessors, primitive, scene));
            if (document.failed()) return;
        }
        if (mesh.primitives.empty())
            document.error(path_to(value, "primitives"), "must hold at least one primitive");
        read_weights(document, value, mesh);
        if (document.failed()) return;
        scene.meshes.push_back(std::move(mesh));
    }
}

}  // namespace gobo::scene
