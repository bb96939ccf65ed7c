#include "lab/scene_picture/posed_mesh.hpp"

#include <glm/matrix.hpp>

#include "lab/render/camera.hpp"
#include "scene/geometry.hpp"

namespace gobo::scene {
namespace {

/// A tangent as the matrix moves the surface; one that mirrors turns the bitangent round.
glm::vec4 turned(const glm::vec4& tangent, const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const float sign = glm::determinant(linear) < 0 ? -1.0F : 1.0F;
    return {unit_or_zero(linear * glm::dvec3(tangent)), sign * tangent.w};
}

/// Adds a morph target's displacements; one without any has none.
void add(float weight, const std::vector<glm::vec3>& target, std::vector<glm::vec3>& to) {
    for (std::size_t i = 0; i < target.size(); ++i) to[i] += weight * target[i];
}

void morph(const Scene& scene, const Node& node, const Primitive& primitive, gobo::Mesh& mesh) {
    const std::vector<double>& weights =
        node.weights.empty() ? scene.meshes[*node.mesh].weights : node.weights;
    for (std::size_t target = 0; target < primitive.target_positions.size(); ++target) {
        const auto weight = static_cast<float>(weights[target]);
        if (weight == 0) continue;
        add(weight, primitive.target_positions[target], mesh.positions);
        if (target < primitive.target_normals.size())
            add(weight, primitive.target_normals[target], mesh.normals);
    }
    if (primitive.has_flat_normals) mesh.normals = flat_normals(mesh.positions);
    if (primitive.target_normals.empty()) return;
    for (glm::vec3& normal : mesh.normals) normal = unit_or_zero(normal);
}

/// To world space, vertex by vertex.
void bend(const Scene& scene, const Skin& skin, const Primitive& primitive, gobo::Mesh& mesh) {
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        joints.push_back(scene.nodes[skin.joints[i]].world * skin.inverse_bind[i]);
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
        if (!mesh.tangents.empty()) mesh.tangents[i] = turned(mesh.tangents[i], matrix);
    }
}

/// All instances as one mesh, each where its matrix puts it. A matrix that mirrors turns triangles round, so
/// that their front stays in front.
gobo::Mesh laid_out(const gobo::Mesh& mesh, const std::vector<glm::dmat4>& instances) {
    gobo::Mesh all;
    for (const glm::dmat4& instance : instances) {
        const glm::dmat3 for_normals = normal_matrix(instance);
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            all.positions.emplace_back(instance * glm::dvec4(mesh.positions[i], 1));
            all.normals.push_back(unit_or_zero(for_normals * glm::dvec3(mesh.normals[i])));
            if (!mesh.tangents.empty()) all.tangents.push_back(turned(mesh.tangents[i], instance));
        }
        all.texcoords.insert(all.texcoords.end(), mesh.texcoords.begin(), mesh.texcoords.end());
        all.texcoords1.insert(all.texcoords1.end(), mesh.texcoords1.begin(), mesh.texcoords1.end());
        all.colors.insert(all.colors.end(), mesh.colors.begin(), mesh.colors.end());
        const bool is_mirrored = glm::determinant(glm::dmat3(instance)) < 0;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::size_t swapped = i % 3 == 0 ? i : (i % 3 == 1 ? i + 1 : i - 1);
            all.indices.push_back(first + mesh.indices[is_mirrored ? swapped : i]);
        }
    }
    return all;
}

/// What OPAQUE materials make of their vertices' alpha: nothing (glTF 2.0 specification, 3.9.4).
std::vector<glm::vec4> seen_colors(const Primitive& primitive, AlphaMode mode) {
    std::vector<glm::vec4> colors = primitive.colors;
    if (mode == AlphaMode::opaque)
        for (glm::vec4& color : colors) color.a = 1;
    return colors;
}

}  // namespace

PosedMesh posed_mesh(const Scene& scene, std::size_t node, const Primitive& primitive) {
    const Node& here = scene.nodes[node];
    PosedMesh posed;
    posed.mesh.positions = primitive.positions;
    posed.mesh.normals = primitive.normals;
    posed.mesh.texcoords = primitive.texcoords;
    posed.mesh.texcoords.resize(primitive.positions.size());
    posed.mesh.colors = seen_colors(primitive, scene.materials[primitive.material].alpha_mode);
    posed.mesh.indices = primitive.indices;
    posed.mesh.texcoords1 = primitive.texcoords1;
    posed.mesh.tangents = primitive.tangents;
    morph(scene, here, primitive, posed.mesh);
    if (!here.instances.empty()) posed.mesh = laid_out(posed.mesh, here.instances);
    if (here.skin && !primitive.influences.empty()) {
        bend(scene, scene.skins[*here.skin], primitive, posed.mesh);
    } else {
        posed.model = here.world;
    }
    return posed;
}

}  // namespace gobo::scene
