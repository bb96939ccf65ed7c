// Meshes at rest: morphed, and bent by their skins.
#include "scene_picture/posed_mesh.hpp"

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
