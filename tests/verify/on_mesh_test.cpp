// That whole pipelines are tried on meshes, and that what joins their stages wrongly is found there.
#include "lab/verify/on_mesh.hpp"

#include <gtest/gtest.h>

#include "lit_library.hpp"

namespace gobo {
namespace {

using verify::VerifyReport;

verify::VerifyOptions with_meshes() {
    const DiskFileSystem disk;
    verify::VerifyOptions options;
    options.meshes =
        verify::test_meshes(read_obj(disk, std::string(GOBO_SOURCE_DIR) + "/data/meshes/teapot.obj").value());
    return options;
}

TEST(OnMesh, PassesTheLibraryAndHasSeenTheMeshes) {
    const Family family = lit_family();
    const Result<VerifyReport> report =
        verify_lit(family,
                   keys_of(family, {"directional=1 specular=blinn", "point=1 shading=vertex",
                                    "depth=any diffuse=toon fog=linear spot=1"}),
                   {}, with_meshes());
    ASSERT_TRUE(report) << to_text(report.error().front());
    EXPECT_EQ(failed_points(*report), 0U);
    for (const verify::PermutationReport& permutation : report->permutations) {
        ASSERT_TRUE(permutation.diagnostics.empty()) << to_text(permutation.diagnostics.front());
        EXPECT_GT(permutation.points_on_meshes, 300U) << "five meshes, a hundred points of each";
        EXPECT_GT(permutation.figures.points, permutation.points_on_meshes + 500U) << "single stages as well";
    }
}

/// A family whose stages are right, each by itself, but joined wrongly.
struct WrongLink {
    std::string name;
    std::string varying;
    std::string interpolation;
    std::string key;
};

TEST(OnMesh, FindsWrongInterpolationsThatPointsCannotSee) {
    const std::vector<WrongLink> links = {
        {"a flat normal", "eyeNormal", "flat", "directional=1"},
        {"a position without perspective", "eyePosition", "noperspective", "fog=linear"},
        {"a radiance without perspective", "litRadiance", "noperspective", "point=1 shading=vertex"},
        {"a flat radiance", "litRadiance", "flat", "point=1 shading=vertex"},
    };
    for (const WrongLink& wrong : links) {
        Family family = lit_family();
        for (Varying& varying : family.varyings)
            if (varying.name == wrong.varying) varying.interpolation = wrong.interpolation;
        const std::vector<Key> keys = keys_of(family, {wrong.key});
        EXPECT_EQ(failed_points(verify_lit(family, keys).value()), 0U) << wrong.name;
        EXPECT_GT(failed_points(verify_lit(family, keys, {}, with_meshes()).value()), 0U) << wrong.name;
    }
}

TEST(OnMesh, FindsAWrongPieceOfEitherStage) {
    const Family family = lit_family();
    const std::vector<std::pair<std::string, std::string>> pieces = {
        {"surface/normal.frag.glsl", "shadingDirection(eyeNormal)"},
        {"surface/normal.vert.glsl", "transform.normalMatrix * normal"}};
    verify::VerifyOptions meshes_alone = with_meshes();
    meshes_alone.vertices = meshes_alone.fragments = 0;
    for (const auto& [path, from] : pieces) {
        std::string text = piece_text(path);
        const auto place = text.find(from);
        ASSERT_NE(place, std::string::npos) << path;
        text.replace(place, from.size(), "-(" + from + ")");
        const auto report =
            verify_lit(family, keys_of(family, {"directional=1"}), {{path, text}}, meshes_alone);
        ASSERT_TRUE(report) << to_text(report.error().front());
        EXPECT_GT(failed_points(*report), 0U) << path;
    }
}

TEST(OnMesh, TheMeshesFitAroundTheOrigin) {
    const std::vector<Mesh> meshes = with_meshes().meshes;
    ASSERT_EQ(meshes.size(), 5U);
    for (const Mesh& mesh : meshes) {
        EXPECT_EQ(mesh.positions.size(), mesh.normals.size());
        for (const glm::vec3& position : mesh.positions)
            EXPECT_LE(std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)}), 1.00001F);
    }
}

}  // namespace
}  // namespace gobo
