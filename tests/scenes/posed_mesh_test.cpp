// Meshes at rest: morphed, and bent by their skins.
#include "lab/scene_picture/posed_mesh.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gobo::scene {
namespace {

/// A triangle that faces +z, on a node one up.
Scene triangle() {
    Scene scene;
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    primitive.indices = {0, 1, 2};
    scene.meshes.push_back({"triangle", {primitive}, {}});
    scene.materials.emplace_back();
    Node node;
    node.mesh = 0;
    node.world = glm::translate(glm::dmat4(1), glm::dvec3(0, 1, 0));
    scene.nodes.push_back(node);
    return scene;
}

PosedMesh posed(const Scene& scene) {
    return posed_mesh(scene, 0, scene.meshes[0].primitives[0]);
}

TEST(PosedMesh, StandsWhereItsNodeIs) {
    const Scene scene = triangle();
    EXPECT_EQ(posed(scene).model, scene.nodes[0].world);
    EXPECT_EQ(posed(scene).mesh.positions, scene.meshes[0].primitives[0].positions);
    EXPECT_EQ(posed(scene).mesh.texcoords.size(), 3U);
}

TEST(PosedMesh, IsMorphedByItsNodesWeightsOrItsOwn) {
    Scene scene = triangle();
    scene.meshes[0].primitives[0].target_positions = {{{0, 0, 2}, {0, 0, 2}, {0, 0, 2}}};
    scene.meshes[0].weights = {0.5};
    EXPECT_EQ(posed(scene).mesh.positions[1], glm::vec3(1, 0, 1));
    scene.nodes[0].weights = {-1};
    EXPECT_EQ(posed(scene).mesh.positions[1], glm::vec3(1, 0, -2));
}

TEST(PosedMesh, MorphedNormalsAreUnitAgain) {
    Scene scene = triangle();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.target_positions = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    primitive.target_normals = {{{1, 0, 0}, {0, 0, 0}, {0, 0, -1}}};
    scene.meshes[0].weights = {1};
    const PosedMesh mesh = posed(scene);
    EXPECT_LT(glm::distance(mesh.mesh.normals[0], glm::normalize(glm::vec3(1, 0, 1))), 1e-6F);
    EXPECT_EQ(mesh.mesh.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.mesh.normals[2], glm::vec3(0)) << "where a morph leaves no normal there is none";
}

TEST(PosedMesh, FlatNormalsFollowTheMorph) {
    Scene scene = triangle();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.has_flat_normals = true;
    primitive.target_positions = {{{0, 0, 0}, {0, 0, 0}, {0, -1, 1}}};
    scene.meshes[0].weights = {1};
    for (const glm::vec3& normal : posed(scene).mesh.normals)
        EXPECT_LT(glm::distance(normal, glm::vec3(0, -1, 0)), 1e-6F);
}

TEST(PosedMesh, InstancesAreLaidOutAndMirroredOnesTurned) {
    Scene scene = triangle();
    scene.nodes[0].instances = {glm::translate(glm::dmat4(1), glm::dvec3(0, 5, 0)),
                                glm::scale(glm::dmat4(1), glm::dvec3(-1, 2, 1))};
    const PosedMesh mesh = posed(scene);
    ASSERT_EQ(mesh.mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.mesh.positions[1], glm::vec3(1, 5, 0));
    EXPECT_EQ(mesh.mesh.positions[4], glm::vec3(-1, 0, 0));
    EXPECT_EQ(mesh.mesh.normals[4], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4}));
    EXPECT_EQ(mesh.model, scene.nodes[0].world);
}

TEST(PosedMesh, OpaqueMaterialsIgnoreTheAlphaOfVertices) {
    Scene scene = triangle();
    scene.meshes[0].primitives[0].colors = {{1, 0, 0, 0.5F}, {1, 1, 1, 0}, {0, 0, 0, 1}};
    EXPECT_EQ(posed(scene).mesh.colors[0], glm::vec4(1, 0, 0, 1));
    scene.materials[0].alpha_mode = AlphaMode::mask;
    EXPECT_EQ(posed(scene).mesh.colors[0], glm::vec4(1, 0, 0, 0.5F));
}

TEST(PosedMesh, IsTakenToTheWorldByItsJoints) {
    Scene scene = triangle();
    scene.nodes[0].skin = 0;
    Node joint;
    joint.world = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(5, 0, 0)), glm::radians(90.0),
                              glm::dvec3(0, 1, 0));
    Node still;
    scene.nodes.insert(scene.nodes.end(), {joint, still});
    scene.skins.push_back({{1, 2}, {glm::dmat4(1), glm::dmat4(1)}});
    scene.meshes[0].primitives[0].influences = {{{0, 1}}, {{0, 1}}, {{0, 0.5F}, {1, 0.5F}}};
    const PosedMesh bent = posed(scene);
    EXPECT_EQ(bent.model, glm::dmat4(1));
    EXPECT_LT(glm::distance(bent.mesh.positions[0], glm::vec3(5, 0, 0)), 1e-6F);
    EXPECT_LT(glm::distance(bent.mesh.positions[1], glm::vec3(5, 0, -1)), 1e-6F);
    EXPECT_LT(glm::distance(bent.mesh.positions[2], glm::vec3(2.5F, 1, 0)), 1e-6F);
    EXPECT_LT(glm::distance(bent.mesh.normals[0], glm::vec3(1, 0, 0)), 1e-6F);
}

TEST(PosedMesh, LeavesWhatNoJointHolds) {
    Scene scene = triangle();
    scene.nodes[0].skin = 0;
    scene.skins.push_back({{0}, {glm::dmat4(1)}});
    scene.meshes[0].primitives[0].influences = {{}, {}, {{0, 1}}};
    EXPECT_EQ(posed(scene).mesh.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(posed(scene).mesh.positions[2], glm::vec3(0, 2, 0));
}

}  // namespace
}  // namespace gobo::scene
