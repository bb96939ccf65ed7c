// The README's still life, drawn by OpenGL, is the oracle's picture.
#include <gtest/gtest.h>

#include "compare_scene.hpp"

namespace gobo::scene {
namespace {

/// Its pictures are filtered by weights of 8 bits, and levels are chosen for four pixels at once: one pixel
/// in fifty may be further off than 4 steps of 255, where the table's grain and the lozenges are smallest.
TEST(PhysicalScenes, AreTheOraclesPicture) {
    const ShippedFamily pbr("pbr");
    const auto studio = Studio::make();
    ASSERT_TRUE(studio) << text_of(studio.error());
    const auto comparison = compare_scene(
        pbr, *studio, std::string(GOBO_SOURCE_DIR) + "/examples/still_life/still_life.gltf", 120, 50);
    ASSERT_TRUE(comparison) << text_of(comparison.error());
    EXPECT_GT(comparison->asked, 4000U);
    EXPECT_LT(comparison->largest, 1e-7);  // of colours, where highlights' terms are a hundred times larger
    EXPECT_GT(comparison->inside, 3000);
    EXPECT_LE(comparison->different * 50, comparison->inside);
    EXPECT_LT(comparison->mean, 1);
}

}  // namespace
}  // namespace gobo::scene
