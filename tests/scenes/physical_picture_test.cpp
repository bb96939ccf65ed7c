// The README's still life, and small scenes of one effect each, drawn by OpenGL are the oracle's pictures.
#include <filesystem>

#include <gtest/gtest.h>

#include "../unit/scene_support.hpp"
#include "compare_scene.hpp"

namespace gobo::scene {
namespace {

/// Its pictures are filtered by weights of 8 bits, and levels are chosen for four pixels at once: one pixel
/// in fifty may be further off than 4 steps of 255, where the table's grain and the lozenges are smallest.
TEST(PhysicalScenes, AreTheOraclesPicture) {
    const ShippedFamily pbr("pbr");
    const auto studio = Studio::make();
    ASSERT_TRUE(studio) << to_text(studio.error());
    const auto comparison = compare_scene(
        pbr, *studio, std::string(GOBO_SOURCE_DIR) + "/examples/still_life/still_life.gltf", 120, 50);
    ASSERT_TRUE(comparison) << to_text(comparison.error());
    EXPECT_GT(comparison->asked, 4000U);
    EXPECT_LT(comparison->largest, 1e-7);  // of colours, where highlights' terms are a hundred times larger
    EXPECT_GT(comparison->inside, 3000);
    EXPECT_LE(comparison->different * 50, comparison->inside);
    EXPECT_LT(comparison->mean, 1);
}

struct SmallScene {
    const char* name;
    const char* light;  ///< of KHR_lights_punctual, half a side before the quad's middle; empty: the studio
    const char* material;  ///< its metallic-roughness factors
    bool has_dark_corner;  ///< a ring of the quad lies beyond the light's range
};
std::ostream& operator<<(std::ostream& out, const SmallScene& scene) {
    return out << scene.name;
}
class SmallScenes : public testing::TestWithParam<SmallScene> {};

TEST_P(SmallScenes, AreTheOraclesPictures) {
    const SmallScene& row = GetParam();
    nlohmann::json json = quad_scene();
    json["materials"] = {{{"pbrMetallicRoughness", nlohmann::json::parse(row.material)}}};
    json["meshes"][0]["primitives"][0]["material"] = 0;
    json["nodes"][1]["translation"] = {0, 0, 0.5};
    json["nodes"][2]["translation"] = {0, 0, 3};
    if (*row.light == 0)
        json["nodes"][1].erase("extensions");
    else
        json["extensions"]["KHR_lights_punctual"]["lights"][0] = nlohmann::json::parse(row.light);
    const std::string folder = testing::TempDir() + "gobo_small_" + row.name;
    std::filesystem::create_directories(folder);
    DiskFileSystem files;
    ASSERT_TRUE(files.write(folder + "/quad.gltf", json.dump()));
    ASSERT_TRUE(files.write(folder + "/quad.bin", quad_buffer()));
    const ShippedFamily pbr("pbr");
    const auto studio = Studio::make();
    ASSERT_TRUE(studio) << to_text(studio.error());
    const auto comparison = compare_scene(pbr, *studio, folder + "/quad.gltf", 48, 48);
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(comparison) << to_text(comparison.error());
    EXPECT_LT(comparison->largest, 1e-7);
    EXPECT_GT(comparison->inside, 400);
    EXPECT_EQ(comparison->different, 0);
    EXPECT_LT(comparison->mean, 0.1);
    int dark = 0;
    for (int y = 12; y < 36; ++y)
        for (int x = 12; x < 36; ++x) dark += comparison->drawn.at(x, y, 0) == 0 ? 1 : 0;
    EXPECT_EQ(dark > 0, row.has_dark_corner) << dark;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SmallScenes,
    testing::Values(SmallScene{"point_that_ends", R"({"type": "point", "intensity": 3, "range": 1.2})",
                               R"({"metallicFactor": 0})", true},
                    SmallScene{"point_that_ends_nowhere", R"({"type": "point", "intensity": 3})",
                               R"({"metallicFactor": 0})", false},
                    SmallScene{
                        "spot_that_ends",
                        R"({"type": "spot", "intensity": 3, "range": 1.1, "spot": {"outerConeAngle": 1.5}})",
                        R"({"metallicFactor": 0.5, "roughnessFactor": 0.5})", true},
                    SmallScene{"smooth_metal_in_the_studio", "", R"({"roughnessFactor": 0})", false},
                    SmallScene{"metal_between_two_levels", "", R"({"roughnessFactor": 0.41})", false},
                    SmallScene{"rough_metal_in_the_studio", "", R"({"roughnessFactor": 1})", false}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::scene
