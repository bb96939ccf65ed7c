// Shadows of surfaces with holes have these holes; what is blended casts none.
#include <filesystem>

#include <gtest/gtest.h>

#include "../unit/scene_support.hpp"
#include "scene/read_scene.hpp"
#include "scene_library.hpp"

namespace gobo::scene {
namespace {

constexpr int kSide = 64;

/// Two white texels, of which the left one is transparent.
constexpr const char* kHalfPicture =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEElEQVR4nGP4//8/AxD/BwAe6gb6OStlagAAAABJRU5ErkJggg==";

/// A floor of 6 x 6, lit from the side by a lamp with a shadow, and the quad, half as large, 0.7 before it.
nlohmann::json scene_with_caster(const std::string& material, const std::string& caster) {
    nlohmann::json json = quad_scene();
    json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
                         nlohmann::json::parse(material)};
    json["images"] = {{{"uri", kHalfPicture}}};
    json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}}};
    json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    const std::string places = float_bytes({0, 1, 1, 1, 1, 0, 0, 0});
    json["buffers"].push_back(
        {{"byteLength", places.size()}, {"uri", "data:application/octet-stream;base64," + base64(places)}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", places.size()}});
    json["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    json["meshes"][0]["primitives"][0]["material"] = 0;
    json["meshes"].push_back(json["meshes"][0]);
    json["meshes"][1]["primitives"][0]["material"] = 1;
    json["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4;
    json["extensions"]["KHR_lights_punctual"]["lights"][0] = {
        {"type", "directional"}, {"intensity", 2}, {"extras", {{"gobo", {{"shadow", true}}}}}};
    json["nodes"][0]["scale"] = {3, 3, 1};
    json["nodes"][1]["rotation"] = {0, 0.5, 0, 0.8660254};
    json["nodes"][2]["translation"] = {0, 0, 6};
    if (!caster.empty()) {
        json["scenes"][0]["nodes"].push_back(json["nodes"].size());
        json["nodes"].push_back(nlohmann::json::parse(caster));
    }
    return json;
}

Image drawn(const nlohmann::json& json) {
    const std::string folder = testing::TempDir() + "gobo_cutout_shadow";
    std::filesystem::create_directories(folder);
    const ShippedFamily pbr("pbr");
    DiskFileSystem files;
    EXPECT_TRUE(files.write(folder + "/quad.gltf", json.dump()));
    EXPECT_TRUE(files.write(folder + "/quad.bin", quad_buffer()));
    const auto scene = read_scene(files, folder + "/quad.gltf", Reading::physical);
    std::filesystem::remove_all(folder);
    EXPECT_TRUE(scene) << to_text(scene.error());
    const auto shaders =
        shaders_for_draws(pbr.family, pbr.search, required_effects(*scene, {}, {}), {}, Dialect::own, 2);
    EXPECT_TRUE(shaders) << to_text(shaders.error());
    const auto context = open_context(Backend::osmesa);
    EXPECT_TRUE(context) << to_text(context.error());
    const DepthPass depth_pass = shipped_depth_pass(1024);
    const auto picture = draw_scene(*context, *scene, *shaders, pbr.family.render,
                                    *view_of_camera(*scene, 0, kSide, kSide), {&depth_pass, {}});
    EXPECT_TRUE(picture) << to_text(picture.error());
    EXPECT_EQ(to_text(picture->warnings), "");
    return picture->color;
}

int different(const Image& a, const Image& b) {
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) count += std::abs(a.at(x, y, 0) - b.at(x, y, 0)) > 0.01F ? 1 : 0;
    return count;
}

constexpr const char* kWhole = R"({"mesh": 1, "scale": [0.5, 0.5, 1], "translation": [0, 0, 0.7]})";
constexpr const char* kRightHalf = R"({"mesh": 1, "scale": [0.25, 0.5, 1], "translation": [0.25, 0, 0.7]})";
constexpr const char* kOpaque = R"({"pbrMetallicRoughness": {"metallicFactor": 0}})";

struct Row {
    const char* name;
    const char* material;  ///< of the whole quad
    const char* equal;     ///< the opaque one that gives the same picture; empty: none
};
class ShadowsOfHoles : public testing::TestWithParam<Row> {};

/// Half a shadow is 50 pixels; where its outline falls between texels of the map, a few may differ.
TEST_P(ShadowsOfHoles, AreThoseOfWhatIsThere) {
    const Image picture = drawn(scene_with_caster(GetParam().material, kWhole));
    EXPECT_LE(different(picture, drawn(scene_with_caster(kOpaque, GetParam().equal))), 4);
    for (const char* other : {kWhole, kRightHalf, ""}) {
        if (other == std::string_view(GetParam().equal)) continue;
        EXPECT_GT(different(picture, drawn(scene_with_caster(kOpaque, other))), 40) << other;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Pbr, ShadowsOfHoles,
    testing::Values(
        Row{"masked_by_a_picture",
            R"({"alphaMode": "MASK", "pbrMetallicRoughness": {"metallicFactor": 0,
                            "baseColorTexture": {"index": 0}}})",
            kRightHalf},
        Row{"masked_below_its_alpha",
            R"({"alphaMode": "MASK", "alphaCutoff": 0, "pbrMetallicRoughness": {"metallicFactor": 0,
                            "baseColorTexture": {"index": 0}}})",
            kWhole},
        Row{"blended",
            R"({"alphaMode": "BLEND", "pbrMetallicRoughness": {"metallicFactor": 0,
                            "baseColorFactor": [1, 1, 1, 0]}})",
            ""}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::scene
