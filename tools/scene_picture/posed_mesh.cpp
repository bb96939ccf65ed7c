#include "scene_picture/posed_mesh.hpp"

#include <glm/geometric.hpp>

#include "render/transform.hpp"

namespace gobo::scene {
namespace {

void morph(const Scene& scene, const Node& node, const Primitive& primitive, gobo::Mesh& mesh) {
    const std::vector<double>& weights =
        node.weights.empty() ? scene.meshes[static_cast<std::size_t>(*node.mesh)].weights : node.weights;
    for (std::size_t target = 0; target < primitive.target_positions.size(); ++target) {
        const auto weight = static_cast<float>(weights[target]);
        for (std::size_t i = 0; weight != 0 && i < mesh.positions.size(); ++i)
            mesh.positions[i] += weight * primitive.target_positions[target][i];
    }
}

glm::vec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? glm::vec3(vector / length) : glm::vec3(0);
}

/// To world space, vertex by vertex.
void bend(const Scene& scene, const Skin& skin, const Primitive& primitive, gobo::Mesh& mesh) {
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        joints.push_back(scene.nodes[static_cast<std::size_t>(skin.joints[i])].world * skin.inverse_bind[i]);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::dmat4 sum(0);
        double weights = 0;
        for (const Influence& influence : primitive.influences[i]) {
            sum += joints[influence.joint] * static_cast<double>(influence.weight);
            weights += static_cast<double>(influence.weight);
        }
        if (weights == 0) continue;
        const glm::dmat4 matrix = sum / weights;
        mesh.positions[i] = glm::vec3(matrix * glm::dvec4(mesh.positions[i], 1));
        mesh.normals[i] = unit_or_zero(normal_matrix(matrix) * glm::dvec3(mesh.normals[i]));
    }
}

}  // namespace

PosedMesh posed_mesh(const Scene& scene, int node, const Primitive& primitive) {
    const Node& here = scene.nodes[static_cast<std::size_t>(node)];
    PosedMesh posed;
    posed.mesh.positions = primitive.positions;
    posed.mesh.normals = primitive.normals;
    posed.mesh.texcoords = primitive.texcoords;
    posed.mesh.texcoords.resize(primitive.positions.size());
    posed.mesh.indices = primitive.indices;
    morph(scene, here, primitive, posed.mesh);
    if (here.skin && !primitive.influences.empty()) {
        bend(scene, scene.skins[static_cast<std::size_t>(*here.skin)], primitive, posed.mesh);
    } else {
        posed.model = here.world;
    }
    return posed;
}

}  // namespace gobo::scene
