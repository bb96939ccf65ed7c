// Scenes drawn by Vulkan, under its validation layer: pictures as those by OpenGL.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "lab/render/image.hpp"

namespace gobo {
namespace {

struct Row {
    const char* name;
    const char* family;
    const char* scene;
    double different;  ///< the share of pixels that may differ by more than 4 of 255 steps of sRGB
};
std::ostream& operator<<(std::ostream& out, const Row& row) {
    return out << row.name;
}

/// At outlines and at the edges of shadows a rounding decides: as many pixels as the pictures of
/// tests/scenes may have that are not the oracle's.
constexpr double kAtEdges = 0.02;

class VulkanScenes : public testing::TestWithParam<Row> {
  protected:
    static Result<Image> drawn_by(const std::string& backend) {
        const Row& row = GetParam();
        const std::string folder =
            fmt::format("{}gobo_vulkan_scene_{}_{}", testing::TempDir(), row.name, backend);
        const std::string command = fmt::format(
            "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation {} render {} --scene {}/{} --format pfm "
            "--size 120x90 --backend {} -o {} > {}.log 2>&1",
            GOBO_PROGRAM, row.family, GOBO_SOURCE_DIR, row.scene, backend, folder, folder);
        DiskFileSystem files;
        EXPECT_EQ(std::system(command.c_str()), 0) << files.read(folder + ".log").value_or("");
        return read_image(files,
                          fmt::format("{}/{}.pfm", folder, std::filesystem::path(row.scene).stem().string()));
    }
};

TEST_P(VulkanScenes, LookAsByOpenGl) {
    const auto one = drawn_by("vulkan");
    const auto other = drawn_by("osmesa");
    ASSERT_TRUE(one && other);
    ASSERT_EQ(one->values.size(), other->values.size());
    const auto signal = [](float radiance) { return srgb_of_linear(std::clamp(radiance, 0.0F, 1.0F)); };
    int different = 0;
    double sum = 0;
    float brightest = 0;
    for (int y = 0; y < one->height; ++y)
        for (int x = 0; x < one->width; ++x) {
            double steps = 0;
            for (int c = 0; c < 3; ++c) {
                steps =
                    std::max(steps, 255 * std::abs(signal(one->at(x, y, c)) - signal(other->at(x, y, c))));
                brightest = std::max(brightest, one->at(x, y, c));
            }
            different += steps > 4 ? 1 : 0;
            sum += steps;
        }
    const double pixels = static_cast<double>(one->width) * one->height;
    EXPECT_LE(different, GetParam().different * pixels);
    EXPECT_LT(sum / pixels, 1);
    EXPECT_GT(brightest, 0.3F) << "something is to be seen";
}

INSTANTIATE_TEST_SUITE_P(
    Rows, VulkanScenes,
    testing::Values(Row{"perforated", "lit", "tests/assets/scenes/made/perforated.gltf", 0},
                    Row{"ten_lights", "lit", "tests/assets/scenes/made/ten_lights.gltf", 0},
                    Row{"leaves", "lit", "tests/assets/scenes/made/leaves.gltf", kAtEdges},
                    Row{"lamp_shadows", "lit", "tests/assets/scenes/made/lamp_shadows.gltf", kAtEdges},
                    Row{"still_life", "pbr", "examples/still_life/still_life.gltf", kAtEdges}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gobo
