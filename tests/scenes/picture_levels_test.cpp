// The smaller levels of pictures lose no texel, whatever the sides.
#include "lab/scene_picture/picture_levels.hpp"

#include <gtest/gtest.h>

#include "../unit/scene_support.hpp"
#include "lab/render/image.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "lab/scene_picture/picture_levels.hpp"
#include "scene/read_scene.hpp"
#include "scene_library.hpp"

namespace gobo::scene {
namespace {

using Bytes = std::vector<int>;

/// A picture of black columns and white ones: every `step`th, from `first` on. Alpha is as the colours.
TextureImage columns(int width, int height, int first, int step) {
    TextureImage picture{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        picture.texels.insert(picture.texels.end(), 4, i % width % step == first ? 255 : 0);
    return picture;
}

struct Row {
    const char* name;
    TextureImage picture;
    Bytes sides;   ///< of the levels: width, height, width, ...
    Bytes second;  ///< the first row's of the second level, linear
    int smallest;  ///< of the smallest level, linear
    int smallest_srgb;
};

void PrintTo(const Row& row, std::ostream* out) {
    *out << row.name;
}

class PictureLevels : public testing::TestWithParam<Row> {};

TEST_P(PictureLevels, AreTheMeansOfWhatTheyCover) {
    const Row& row = GetParam();
    const auto levels = picture_levels(row.picture, false);
    Bytes sides;
    for (const TextureImage& level : levels) {
        sides.insert(sides.end(), {level.width, level.height});
        ASSERT_EQ(level.texels.size(), 4U * level.width * level.height);
    }
    EXPECT_EQ(sides, row.sides);
    Bytes second;
    for (int x = 0; x < std::min(levels[1].width, 4); ++x) second.push_back(levels[1].texels[4 * x]);
    EXPECT_EQ(second, row.second);
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    const std::uint8_t linear = byte(row.smallest);
    const std::uint8_t srgb = byte(row.smallest_srgb);
    EXPECT_EQ(levels.back().texels, std::vector(4, linear));
    EXPECT_EQ(picture_levels(row.picture, true).back().texels, (std::vector{srgb, srgb, srgb, linear}));
}

/// The quad, unlit, with that picture, seen from the front so that it fills the view.
Result<Scene> scene_of(const TextureImage& picture) {
    nlohmann::json scene = quad_scene();
    // The file's own picture, of one texel, is replaced once it is read.
    scene["images"] = {{{"uri",
                         "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACk"
                         "lEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg=="}}};
    scene["textures"] = {{{"source", 0}}};
    scene["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                             {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}};
    scene["cameras"][0] = {{"type", "orthographic"},
                           {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}}}};
    const std::string places = float_bytes({0, 1, 1, 1, 1, 0, 0, 0});
    scene["buffers"].push_back(
        {{"byteLength", places.size()}, {"uri", "data:application/octet-stream;base64," + base64(places)}});
    scene["bufferViews"].push_back({{"buffer", 1}, {"byteLength", places.size()}});
    scene["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    scene["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4;
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"quad.gltf", scene.dump()}, {"quad.bin", quad_buffer()}});
    GOBO_TRY(Scene read, read_scene(files, "quad.gltf", Reading::physical));
    read.pictures.at(0) = picture;
    return read;
}

/// Drawn onto one pixel, a picture is its smallest level. Filters' weights have 8 bits.
TEST_P(PictureLevels, AreDrawn) {
    const ShippedFamily pbr("pbr");
    const auto scene = scene_of(GetParam().picture);
    ASSERT_TRUE(scene) << to_text(scene.error());
    const auto shaders = shaders_for_draws(
        pbr.family, pbr.search, required_effects(*scene, eye_of_cameras(*scene), {}), {}, Dialect::own, 1);
    ASSERT_TRUE(shaders) << to_text(shaders.error());
    for (const Backend backend : {Backend::osmesa, Backend::egl}) {
        const auto context = open_context(backend);
        ASSERT_TRUE(context) << to_text(context.error());
        const auto picture =
            draw_scene(*context, *scene, *shaders, pbr.family.render, *view_of_camera(*scene, 0, 1, 1));
        ASSERT_TRUE(picture) << to_text(picture.error());
        EXPECT_NEAR(picture->color.at(0, 0, 0), linear_of_srgb(GetParam().smallest_srgb / 255.0), 1.0 / 255);
    }
}

// Means of white (255): 85 is a third, whose sRGB is 156; 43 a sixth (113, but 114 of the level above, whose
// half is rounded up); 51 a fifth (124); 64 a quarter (137).
const Row rows[] = {
    {"3x1_left", columns(3, 1, 0, 3), {3, 1, 1, 1}, {85}, 85, 156},
    {"3x1_middle", columns(3, 1, 1, 3), {3, 1, 1, 1}, {85}, 85, 156},
    {"3x1_right", columns(3, 1, 2, 3), {3, 1, 1, 1}, {85}, 85, 156},
    {"6x1", columns(6, 1, 0, 6), {6, 1, 3, 1, 1, 1}, {128, 0, 0}, 43, 114},
    {"5x3", columns(5, 3, 2, 5), {5, 3, 2, 1, 1, 1}, {51, 51}, 51, 124},
    {"255x129",
     columns(255, 129, 0, 3),
     {255, 129, 127, 64, 63, 32, 31, 16, 15, 8, 7, 4, 3, 2, 1, 1},
     {127, 127, 3, 124},
     85,
     156},
    {"4x4", columns(4, 4, 3, 4), {4, 4, 2, 2, 1, 1}, {0, 128}, 64, 137},
};

INSTANTIATE_TEST_SUITE_P(Pictures, PictureLevels, testing::ValuesIn(rows),
                         [](const auto& row) { return "of_" + std::string(row.param.name); });

}  // namespace
}  // namespace gobo::scene
