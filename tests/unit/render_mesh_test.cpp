// Meshes, cameras and matrices.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "lab/render/camera.hpp"
#include "lab/render/mesh.hpp"

namespace gobo {
namespace {

Mesh read(const std::string& text) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{{"mesh.obj", text}});
    const auto mesh = read_obj(files, "mesh.obj");
    EXPECT_TRUE(mesh) << to_text(mesh.error().front());
    return mesh.value_or(Mesh());
}

void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << i;
}

/// The volume enclosed: positive where the triangles run counter-clockwise seen from outside.
double signed_volume(const Mesh& mesh) {
    double volume = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
}

struct Closed {
    const char* name;
    Mesh mesh;
    double volume;
};

class ClosedMeshes : public testing::TestWithParam<Closed> {};

TEST_P(ClosedMeshes, FacesAndNormalsPointOutward) {
    const Mesh& mesh = GetParam().mesh;
    // An inscribed polyhedron of 64 slices lacks about (2 pi / 64)^2 / 3 = 0.3 % a curved direction.
    EXPECT_NEAR(signed_volume(mesh), GetParam().volume, 0.01 * GetParam().volume);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 face =
            glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        for (std::size_t corner = 0; corner < 3; ++corner)
            EXPECT_GE(glm::dot(face, mesh.normals[mesh.indices[i + corner]]), 0.0F);
    }
}

constexpr double pi = std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(Mesh, ClosedMeshes,
                         testing::Values(Closed{"sphere", make_sphere(64, 32), 4 * pi / 3},
                                         Closed{"torus", make_torus(2, 0.5, 64, 64), 2 * pi* pi * 2 * 0.25}),
                         [](const auto& row) { return row.param.name; });

TEST(Mesh, PlaneFacesUp) {
    const Mesh plane = make_plane(4, 2);
    EXPECT_EQ(plane.positions.size(), 9U);
    EXPECT_EQ(plane.indices.size(), 24U);
    EXPECT_EQ(plane.positions.front(), glm::vec3(-2, 0, 2));
    const glm::vec3 a = plane.positions[plane.indices[0]];
    const glm::vec3 face =
        glm::cross(plane.positions[plane.indices[1]] - a, plane.positions[plane.indices[2]] - a);
    EXPECT_EQ(face, glm::vec3(0, 4, 0));
}

TEST(Obj, NormalsAreWeldedByPositionAndWeightedByArea) {
    // A ridge of two faces that share the edge x = 0 through different vertices; the left one is twice as
    // large.
    const Mesh mesh = read(
        "v 0 0 0\nv 0 0 1\nv 1 -0.5 0\n"
        "v 0 0 0\nv 0 0 1\nv -2 -1 0\n"
        "f 1 2 3\nf 4 6 5\n");
    ASSERT_EQ(mesh.positions.size(), 4U);
    const glm::dvec3 right = glm::dvec3(0.5, 1, 0);  // twice the right face's area times its normal
    const glm::dvec3 left = glm::dvec3(-1, 2, 0);
    // Tolerance: normals are stored as floats.
    expect_near(mesh.normals[0], glm::normalize(right + left), 1e-7);
    expect_near(mesh.normals[2], glm::normalize(right), 1e-7);
}

TEST(Obj, ACreaseStaysSharp) {
    const Mesh mesh = read("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 2\n");
    ASSERT_EQ(mesh.positions.size(), 6U);
    expect_near(mesh.normals[0], {0, 1, 0}, 0);
    expect_near(mesh.normals[3], {-1, 0, 0}, 0);
}

TEST(Obj, OwnNormalsAndTexcoordsAreKept) {
    const Mesh mesh =
        read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0.25 0.75\nf 1/1/1 2/1/1 3/1/1 4/1/1\n");
    ASSERT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.indices.size(), 6U);
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.texcoords[3], glm::vec2(0.25F, 0.75F));
}

TEST(Obj, TeapotIsSmooth) {
    const DiskFileSystem files;
    const auto mesh = read_obj(files, GOBO_SOURCE_DIR "/data/meshes/teapot.obj");
    ASSERT_TRUE(mesh) << to_text(mesh.error().front());
    EXPECT_EQ(mesh->indices.size() % 3, 0U);
    EXPECT_GT(mesh->indices.size() / 3,
              900U);  // of 992: the poles of lid and base have triangles without area
    EXPECT_LT(mesh->positions.size(), 900U);
    for (const glm::vec3& normal : mesh->normals) EXPECT_NEAR(glm::length(normal), 1, 1e-6);
}

struct BadObj {
    const char* name;
    const char* content;
    const char* text;
};

class BadObjFiles : public testing::TestWithParam<BadObj> {};

TEST_P(BadObjFiles, AreReported) {
    const MemoryFileSystem files(
        std::map<std::string, std::string, std::less<>>{{"mesh.obj", GetParam().content}});
    const auto mesh = read_obj(files, "mesh.obj");
    ASSERT_FALSE(mesh);
    EXPECT_EQ(to_text(mesh.error().front()), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Obj, BadObjFiles,
    testing::Values(
        BadObj{"empty", "# nothing\n", "mesh.obj: error: this is not a readable OBJ file: it has no faces\n"},
        BadObj{
            "index", "v 0 0 0\nv 1 0 0\nf 1 2 7\n",
            "mesh.obj: error: this is not a readable OBJ file: a face names a vertex that does not exist\n"},
        BadObj{"infinite", "v 0 0 0\nv 1 0 0\nv 1e999 0 0\nf 1 2 3\n",
               "mesh.obj: error: this is not a readable OBJ file: a position is not finite\n"}),
    [](const auto& row) { return row.param.name; });

struct NormalMatrixRow {
    const char* name;
    glm::dmat4 matrix;
    glm::dmat3 expected;
};

class NormalMatrix : public testing::TestWithParam<NormalMatrixRow> {};

TEST_P(NormalMatrix, IsTheInverseTranspose) {
    const glm::dmat3 result = normal_matrix(GetParam().matrix);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            const double expected = GetParam().expected[column][row];
            // A dozen double-precision roundings.
            EXPECT_NEAR(result[column][row], expected, 1e-14 * std::max(1.0, std::abs(expected)));
        }
}

const glm::dmat4 rotation = glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3));
INSTANTIATE_TEST_SUITE_P(
    Transform, NormalMatrix,
    testing::Values(NormalMatrixRow{"rotation_stays", rotation, glm::dmat3(rotation)},
                    NormalMatrixRow{"translation_is_ignored", glm::translate(rotation, glm::dvec3(5, 6, 7)),
                                    glm::dmat3(rotation)},
                    NormalMatrixRow{"scale", glm::scale(glm::dmat4(1), glm::dvec3(2, 4, 0.5)),
                                    glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(0.5, 0.25, 2)))},
                    NormalMatrixRow{"mirror", glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)),
                                    glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)))},
                    NormalMatrixRow{"flattened", glm::scale(glm::dmat4(1), glm::dvec3(2, 0, 2)),
                                    glm::dmat3(glm::scale(glm::dmat4(1), glm::dvec3(0, 1, 0)))},
                    NormalMatrixRow{"tiny", glm::scale(glm::dmat4(1), glm::dvec3(1e-200)), glm::dmat3(1)}),
    [](const auto& row) { return row.param.name; });

TEST(Camera, ProjectsItsTargetToTheMiddle) {
    const Camera camera;
    const glm::dvec4 clip = camera.projection(1.5) * camera.view() * glm::dvec4(camera.target, 1);
    EXPECT_EQ(clip.x, 0);
    EXPECT_EQ(clip.y, 0);
    EXPECT_DOUBLE_EQ(clip.w, 5);  // the distance along the line of sight
}

}  // namespace
}  // namespace gobo
