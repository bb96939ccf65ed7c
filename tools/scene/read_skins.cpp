#include <algorithm>

#include <fmt/format.h>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

void read_inverse_bind(Document& document, Accessors& accessors, const Value& value, Skin& skin) {
    skin.inverse_bind.assign(skin.joints.size(), glm::dmat4(1));
    const auto index = document.index(value, "inverseBindMatrices", accessors.size(), "accessors");
    if (!index) return;
    const std::string user = path_to(value, "inverseBindMatrices");
    const Values values = accessors.read(*index, {{"MAT4"}, {Component::float_number}}, user);
    if (values.count < skin.joints.size()) {
        document.error(user, fmt::format("has {} matrices for {} joints", values.count, skin.joints.size()));
        return;
    }
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        for (std::size_t k = 0; k < 16; ++k) {
            const auto column = static_cast<glm::length_t>(k / 4);
            skin.inverse_bind[i][column][static_cast<glm::length_t>(k % 4)] = values.at(i, k);
        }
    }
}

/// One more than the greatest joint that a mesh names.
std::uint32_t joints_named(const Mesh& mesh) {
    std::uint32_t count = 0;
    for (const Primitive& primitive : mesh.primitives)
        for (const auto& influences : primitive.influences)
            for (const Influence& influence : influences) count = std::max(count, influence.joint + 1);
    return count;
}

/// Every joint that a skinned mesh names must be one of its skin's.
void check_influences(Document& document, const Scene& scene) {
    std::vector<std::uint32_t> named;
    for (const Mesh& mesh : scene.meshes) named.push_back(joints_named(mesh));
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (document.failed() || !node.skin || !node.mesh) continue;
        const std::size_t joints = scene.skins[static_cast<std::size_t>(*node.skin)].joints.size();
        const std::uint32_t count = named[static_cast<std::size_t>(*node.mesh)];
        if (count <= joints) continue;
        document.error(fmt::format("meshes[{}]", *node.mesh),
                       fmt::format("names joint {}, but skins[{}] of nodes[{}] has {} joints", count - 1,
                                   *node.skin, i, joints));
    }
}

}  // namespace

void read_skins(Document& document, Accessors& accessors, Scene& scene) {
    for (const Value& value : document.objects(document.root(), "skins")) {
        Skin skin;
        skin.joints = document.indices(value, "joints", scene.nodes.size(), "nodes");
        if (skin.joints.empty()) document.error(path_to(value, "joints"), "must name at least one node");
        read_inverse_bind(document, accessors, value, skin);
        if (document.failed()) return;
        scene.skins.push_back(std::move(skin));
    }
    check_influences(document, scene);
}

}  // namespace gobo::scene
