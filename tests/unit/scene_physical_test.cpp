// Scenes read for metallic-roughness materials: factors, pictures, tangents, the light that stands in.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <lodepng.h>

#include "scene/draw_values.hpp"
#include "scene/effects.hpp"
#include "scene/picture.hpp"
#include "scene/read_scene.hpp"
#include "scene/scene_keys.hpp"
#include "scene_support.hpp"

namespace gobo::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string png(const std::vector<unsigned char>& rgba, unsigned width, unsigned height) {
    std::vector<unsigned char> bytes;
    EXPECT_EQ(lodepng::encode(bytes, rgba, width, height), 0U);
    return "data:image/png;base64," + base64(std::string(bytes.begin(), bytes.end()));
}

/// 8 x 8 texels of one grey; progressive in several scans. Other colours have as many components as they do.
std::string jpeg(unsigned char grey, bool is_progressive = false, J_COLOR_SPACE colors = JCS_GRAYSCALE) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &bytes, &size);
    info.image_width = info.image_height = 8;
    info.input_components = colors == JCS_CMYK ? 4 : 1;
    info.in_color_space = colors;
    jpeg_set_defaults(&info);
    if (is_progressive) jpeg_simple_progression(&info);
    jpeg_start_compress(&info, TRUE);
    std::vector<unsigned char> row(std::size_t{8} * static_cast<std::size_t>(info.input_components), grey);
    JSAMPROW rows[] = {row.data()};
    for (int i = 0; i < 8; ++i) jpeg_write_scanlines(&info, rows, 1);
    jpeg_finish_compress(&info);
    std::string text(reinterpret_cast<char*>(bytes), size);
    free(bytes);
    jpeg_destroy_compress(&info);
    return text;
}

Result<Scene> read_physical_scene(const nlohmann::json& json) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"quad.gltf", json.dump()}, {"quad.bin", quad_buffer()}, {"grey.jpg", jpeg(100)}});
    return read_scene(files, "quad.gltf", Reading::physical);
}

/// Gives the quad's mesh an attribute of floats.
void add_attribute(nlohmann::json& scene, const char* name, const char* type, const std::string& bytes) {
    const std::size_t buffer = scene["buffers"].size();
    scene["meshes"][0]["primitives"][0]["attributes"][name] = scene["accessors"].size();
    scene["buffers"].push_back(
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    scene["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", bytes.size()}});
    scene["accessors"].push_back({{"bufferView", scene["bufferViews"].size() - 1},
                                  {"componentType", 5126},
                                  {"count", 4},
                                  {"type", type}});
}

/// The quad's scene with this material and picture.
nlohmann::json scene_with(const std::string& material, const std::string& image) {
    nlohmann::json scene = quad_scene();
    scene["materials"] = nlohmann::json::array({nlohmann::json::parse(material)});
    scene["images"] = {{{"uri", image}}};
    scene["textures"] = {{{"source", 0}}};
    scene["meshes"][0]["primitives"][0]["material"] = 0;
    // Texture coordinates of the usual picture, v running down.
    add_attribute(scene, "TEXCOORD_0", "VEC2", float_bytes({0, 1, 1, 1, 1, 0, 0, 0}));
    return scene;
}

TEST(PhysicalScene, ReadsFactorsAndExtensions) {
    const Result<Scene> scene = read_physical_scene(scene_with(R"({"pbrMetallicRoughness":
        {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.25},
        "extensions": {"KHR_materials_ior": {"ior": 2}, "KHR_materials_specular": {"specularFactor": 0.5},
                       "KHR_materials_clearcoat": {"clearcoatFactor": 0.75},
                       "KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceIor": 1.8},
                       "KHR_materials_transmission": {"transmissionFactor": 1}}})",
                                                               png({255, 255, 255, 255}, 1, 1)));
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    const PhysicalMaterial& material = scene->materials[0].physical;
    EXPECT_EQ(material.base_color, glm::dvec4(0.1, 0.2, 0.3, 0.4));
    EXPECT_EQ(material.metallic, 0.5);
    EXPECT_EQ(material.roughness, 0.25);
    EXPECT_DOUBLE_EQ(material.dielectric.g, 0.5 / 9);  // ((2 - 1) / (2 + 1))^2
    EXPECT_EQ(material.dielectric_edge, 0.5);
    EXPECT_THAT(material.of_extensions.at("Material.clearcoat"), ElementsAre(0.75));
    EXPECT_THAT(material.of_extensions.at("Iridescence.factor"), ElementsAre(0.5));
    EXPECT_THAT(material.of_extensions.at("Iridescence.ior"), ElementsAre(1.8));
    EXPECT_THAT(material.of_extensions.at("Iridescence.thickness"), ElementsAre(400));
    EXPECT_THAT(material.not_drawn, ElementsAre("KHR_materials_transmission"));
}

TEST(PhysicalScene, MayRequireWhatItReads) {
    nlohmann::json scene = scene_with("{}", png({255, 255, 255, 255}, 1, 1));
    scene["extensionsRequired"] = {"KHR_materials_anisotropy",        "KHR_materials_clearcoat",
                                   "KHR_materials_emissive_strength", "KHR_materials_ior",
                                   "KHR_materials_iridescence",       "KHR_materials_sheen",
                                   "KHR_materials_specular",          "KHR_materials_unlit"};
    EXPECT_TRUE(read_physical_scene(scene));
    scene["extensionsRequired"] = {"KHR_materials_transmission"};
    EXPECT_FALSE(read_physical_scene(scene));
}

TEST(PhysicalScene, TellsWhichPicturesAreNotDrawn) {
    nlohmann::json scene = scene_with(R"({"emissiveTexture": {"index": 1}, "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0, "texCoord": 3}}})",
                                      png({255, 255, 255, 255}, 1, 1));
    scene["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    const Result<Scene> read = read_physical_scene(scene);
    ASSERT_TRUE(read) << to_text(read.error().front());
    EXPECT_THAT(read->materials[0].physical.not_drawn,
                ElementsAre("baseColorTexture by texCoord 3", "emissiveTexture by KHR_texture_basisu alone"));
}

/// Of the first draw: the effect's reason, and "in: " before it where it is in.
std::string verdict(const Scene& scene, const std::string& name) {
    const std::vector<Draw> draws = required_effects(scene, {}, {});
    for (const Effect& effect : draws.front().effects)
        if (effect.name == name) return (effect.is_in ? "in: " : "") + effect.reason;
    return "not judged";
}

TEST(PhysicalScene, LeavesOutPicturesThatChangeNothing) {
    struct Row {
        const char* name;
        std::vector<unsigned char> texel;
        const char* material;
        const char* effect;
        const char* verdict;
    };
    const Row rows[] = {
        {"white",
         {255, 255, 255, 255},
         R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
         "base_color_map",
         "it is white"},
        {"grey",
         {255, 254, 255, 255},
         R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
         "base_color_map",
         "in: 1 x 1 texels"},
        {"alpha of an opaque one",
         {255, 255, 255, 9},
         R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
         "base_color_map",
         "it is white"},
        {"alpha of a blended one",
         {255, 255, 255, 9},
         R"({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
         "base_color_map",
         "in: 1 x 1 texels"},
        {"flat, one way",
         {127, 128, 255, 255},
         R"({"normalTexture": {"index": 0}})",
         "normal_map",
         "it is flat"},
        {"bent",
         {130, 128, 255, 255},
         R"({"normalTexture": {"index": 0}})",
         "normal_map",
         "in: 1 x 1 texels"},
        {"scale 0",
         {130, 128, 255, 255},
         R"({"normalTexture": {"index": 0, "scale": 0}})",
         "normal_map",
         "its scale is 0"},
        {"red alone occludes",
         {255, 1, 2, 255},
         R"({"occlusionTexture": {"index": 0}})",
         "occlusion_map",
         "it is white"},
        {"no emission",
         {9, 9, 9, 255},
         R"({"emissiveTexture": {"index": 0}})",
         "emissive_map",
         "its material emits nothing"},
        {"the third set",
         {9, 9, 9, 255},
         R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 2}}})",
         "base_color_map",
         "its texture coordinates are set 2, of which 0 and 1 are read"}};
    for (const Row& row : rows) {
        const Result<Scene> scene = read_physical_scene(scene_with(row.material, png(row.texel, 1, 1)));
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        EXPECT_EQ(verdict(*scene, row.effect), row.verdict) << row.name;
    }
}

/// The lamp of quad.gltf stands 2 above the middle of the quad.
TEST(PhysicalScene, EndsLocalLightsAtTheirRange) {
    struct Row {
        const char* name;
        const char* light;
        const char* verdict;
        std::vector<double> position;  ///< of the first point light
    };
    const Row rows[] = {
        {"without", R"({"type": "point"})", "no local light with a range is in", {0, 0, 2, 0}},
        {"with", R"({"type": "point", "range": 4})", "in: point 0 ends at 4", {0, 0, 2, 0.25}},
        {"large", R"({"type": "point", "range": 200})", "in: point 0 ends at 200", {0, 0, 2, 0.005}},
        {"vast",
         R"({"type": "point", "range": 1000})",
         "point 0 ends at 1e+03, too far away to dim it by a float's rounding",
         {0, 0, 2, 0.001}},
        {"beyond", R"({"type": "point", "range": 1})", "no local light with a range is in", {}},
        {"directional", R"({"type": "directional", "range": 4})", "no local light with a range is in", {}}};
    for (const Row& row : rows) {
        nlohmann::json json = scene_with("{}", png({9, 9, 9, 255}, 1, 1));
        json["extensions"]["KHR_lights_punctual"]["lights"][0] = nlohmann::json::parse(row.light);
        const Result<Scene> scene = read_physical_scene(json);
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        EXPECT_EQ(verdict(*scene, "light_range"), row.verdict) << row.name;
        std::vector<double> position;
        for (const RenderValue& value : values_of_draw(*scene, required_effects(*scene, {}, {}).front()))
            if (value.name == "PointLights.lights[0].position" && value.source == "eye_point_and")
                position = value.numbers;
        EXPECT_EQ(position, row.position) << row.name;
    }
}

TEST(PhysicalScene, IsOfferedToWhoReadsItForLit) {
    struct Row {
        const char* name;
        const char* material;
        const char* told;
        bool has_light = true;
    };
    constexpr const char* kMetal = R"({"pbrMetallicRoughness": {"metallicFactor": 0.5}})";
    const Row rows[] = {
        {"metal", kMetal, "quad.gltf: family pbr draws its textures and metals as they are"},
        {"a dielectric", R"({"pbrMetallicRoughness": {"metallicFactor": 0}})", nullptr},
        {"nothing stated", "{}", nullptr},
        {"textured", R"({"normalTexture": {"index": 0}})",
         "quad.gltf: family pbr draws its textures and metals as they are"},
        {"unlit",
         R"({"pbrMetallicRoughness": {"metallicFactor": 1}, "extensions": {"KHR_materials_unlit": {}}})",
         nullptr},
        {"a model of lit",
         R"({"pbrMetallicRoughness": {"metallicFactor": 1}, "extras": {"gobo": {"model": {"diffuse": [1, 1, 1]}}}})",
         nullptr},
        {"dark", "{}", "quad.gltf: family pbr lights it with a studio, as it has no light", false},
        {"dark metal", kMetal,
         "quad.gltf: family pbr draws its textures and metals as they are and lights it with a studio, as it "
         "has no light",
         false}};
    for (const Row& row : rows) {
        nlohmann::json json = scene_with(row.material, png({9, 9, 9, 255}, 1, 1));
        if (!row.has_light) json["nodes"][1].erase("extensions");
        const Result<Scene> scene = read_json(json);
        const Result<Scene> physical = read_physical_scene(json);
        ASSERT_TRUE(scene && physical) << row.name;
        std::vector<std::string> told;
        if (row.told != nullptr) told.emplace_back(row.told);
        EXPECT_EQ(notes_on_scene(*scene, {}, {}), told) << row.name;
        EXPECT_THAT(notes_on_scene(*physical, {}, {}), testing::IsEmpty()) << row.name;
    }
}

TEST(PhysicalScene, TellsWhatTheMeshDoesNotLetBeDrawn) {
    struct Row {
        const char* name;
        const char* material;
        const char* target;  ///< an attribute that its morph targets have
        const char* lost;
        const char* verdict;
    };
    const Row rows[] = {
        {"set 1", R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}})", nullptr,
         "base_color_map of a mesh without TEXCOORD_1", "its mesh has no texture coordinates of set 1"},
        {"set 0", R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})", nullptr,
         "base_color_map of a mesh without TEXCOORD_0", "its mesh has no texture coordinates of set 0"},
        {"brushed", R"({"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}})", nullptr,
         "anisotropy of a mesh with neither tangents nor texture coordinates", "it has none"},
        {"morphed colours", "{}", "COLOR_0", "morph targets of COLOR_0", "it has none"},
        {"morphed places", "{}", "TEXCOORD_0", "morph targets of TEXCOORD_0", "it has none"},
    };
    for (const Row& row : rows) {
        nlohmann::json json = scene_with(row.material, png({9, 9, 9, 255}, 1, 1));
        nlohmann::json& primitive = json["meshes"][0]["primitives"][0];
        if (row.name != std::string("set 1")) primitive["attributes"].erase("TEXCOORD_0");
        if (row.target != nullptr) primitive["targets"] = {{{row.target, 0}}};
        const Result<Scene> scene = read_physical_scene(json);
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        EXPECT_THAT(verdict(*scene, row.lost), testing::StartsWith("in: ")) << row.name;
        EXPECT_EQ(verdict(*scene, "base_color_map"), row.verdict) << row.name;
        for (const Row& other : rows) {
            if (&other == &row) continue;
            EXPECT_EQ(verdict(*scene, other.lost), "not judged") << row.name;
        }
    }
}

TEST(PhysicalScene, ReadsJpegAndSaysWhatIsNone) {
    nlohmann::json json =
        scene_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})", "grey.jpg");
    const Result<Scene> scene = read_physical_scene(json);
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    ASSERT_EQ(scene->pictures.size(), 1U);
    EXPECT_EQ(scene->pictures[0].width, 8);
    EXPECT_THAT(std::vector(scene->pictures[0].texels.begin(), scene->pictures[0].texels.begin() + 4),
                ElementsAre(100, 100, 100, 255));
    json["images"][0]["uri"] = "data:image/jpeg;base64," + base64("\xff\xd8\xff");
    EXPECT_EQ(read_physical_scene(json).error().front().message,
              "images[0] is no JPEG that can be decoded: Premature end of JPEG file");
    EXPECT_EQ(read_physical_scene(json).error().front().help, "");
}

TEST(PhysicalScene, SaysHowToConvertAPictureThatIsNotRead) {
    struct Row {
        const char* name;
        std::string bytes;
        const char* message;
        const char* help;
    };
    const Row rows[] = {
        {"KTX 2", "\xabKTX 20\xbb\r\n\x1a\n", "images[0] is KTX 2, but PNG and JPEG are read",
         "convert it (ktx extract FILE.ktx2 FILE.png), and let the texture's source name the PNG"},
        {"WebP", std::string("RIFF\x1a\0\0\0WEBPVP8L", 16), "images[0] is WebP, but PNG and JPEG are read",
         "convert it (dwebp FILE.webp -o FILE.png), and let the texture's source name the PNG"},
        {"AVIF",
         std::string("\0\0\0\x1c"
                     "ftypavif",
                     12),
         "images[0] is AVIF, but PNG and JPEG are read",
         "convert it (avifdec FILE.avif FILE.png), and let the texture's source name the PNG"},
        {"DDS", "DDS |", "images[0] is DDS, but PNG and JPEG are read",
         "convert it (convert FILE.dds FILE.png), and let the texture's source name the PNG"},
        {"another", "GIF89a", "images[0] is neither PNG nor JPEG", "convert it to one of them"},
        {"nothing", "", "images[0] is neither PNG nor JPEG", "convert it to one of them"},
    };
    for (const Row& row : rows) {
        const Result<Scene> scene =
            read_physical_scene(scene_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                                           "data:application/octet-stream;base64," + base64(row.bytes)));
        ASSERT_FALSE(scene) << row.name;
        EXPECT_EQ(scene.error().front().message, row.message) << row.name;
        EXPECT_EQ(scene.error().front().help, row.help) << row.name;
    }
}

// Of the usual picture T runs to the right and N x T, for w = 1, up.
TEST(PhysicalScene, MakesTangentsAsMikkTSpaceHasThem) {
    const std::string bent = png({130, 128, 255, 255}, 1, 1);
    nlohmann::json json = scene_with(R"({"normalTexture": {"index": 0}})", bent);
    const auto tangents = [&] {
        const Result<Scene> scene = read_physical_scene(json);
        EXPECT_TRUE(scene) << to_text(scene.error().front());
        return scene->meshes[0].primitives[0].tangents;
    };
    add_attribute(json, "NORMAL", "VEC3", float_bytes({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
    ASSERT_EQ(tangents().size(), 4U);
    for (const glm::vec4& tangent : tangents()) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
    const std::string mirrored = float_bytes({1, 1, 0, 1, 0, 0, 1, 0});
    json["buffers"][1]["uri"] = "data:application/octet-stream;base64," + base64(mirrored);
    for (const glm::vec4& tangent : tangents()) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
    // One triangle of each: the two vertices that they share become four.
    const std::string half = float_bytes({0, 1, 1, 1, 1, 0, 2, 0});
    json["buffers"][1]["uri"] = "data:application/octet-stream;base64," + base64(half);
    EXPECT_EQ(tangents().size(), 6U);
}

/// As T runs to the right and N x T up on the usual picture, so both run on one that is turned or mirrored.
TEST(PhysicalScene, MakesTangentsOfTheCoordinatesThatTheNormalPictureIsLookedUpBy) {
    struct Row {
        const char* name;
        const char* transform;
        glm::vec4 tangent;
        bool has_own = false;  ///< the mesh states tangents
    };
    const Row rows[] = {
        {"as it is", "{}", {1, 0, 0, 1}},
        {"moved and stretched", R"({"offset": [0.5, 2], "scale": [2, 3]})", {1, 0, 0, 1}},
        {"turned by a quarter", R"({"rotation": 1.5707963267948966})", {0, -1, 0, 1}},
        {"upside down", R"({"rotation": 3.141592653589793})", {-1, 0, 0, 1}},
        {"mirrored from left to right", R"({"scale": [-1, 1]})", {-1, 0, 0, -1}},
        {"mirrored from top to bottom", R"({"scale": [1, -1]})", {1, 0, 0, -1}},
        {"by the second set", R"({"texCoord": 1})", {0, 1, 0, 1}},
        {"stated by the mesh", R"({"rotation": 1.5707963267948966})", {0, 0.6F, 0.8F, -1}, true},
    };
    for (const Row& row : rows) {
        nlohmann::json json =
            scene_with(R"({"normalTexture": {"index": 0}})", png({130, 128, 255, 255}, 1, 1));
        json["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] =
            nlohmann::json::parse(row.transform);
        add_attribute(json, "NORMAL", "VEC3", float_bytes({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
        add_attribute(json, "TEXCOORD_1", "VEC2", float_bytes({0, 0, 0, 1, 1, 1, 1, 0}));
        if (row.has_own)
            add_attribute(
                json, "TANGENT", "VEC4",
                float_bytes({0, 0.6F, 0.8F, -1, 0, 0.6F, 0.8F, -1, 0, 0.6F, 0.8F, -1, 0, 0.6F, 0.8F, -1}));
        const Result<Scene> scene = read_physical_scene(json);
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        const std::vector<glm::vec4>& tangents = scene->meshes[0].primitives[0].tangents;
        ASSERT_EQ(tangents.size(), 4U) << row.name;
        for (const glm::vec4& tangent : tangents)
            EXPECT_LT(glm::length(tangent - row.tangent), 1e-6F)
                << row.name << ": " << tangent.x << " " << tangent.y << " " << tangent.z << " " << tangent.w;
    }
}

TEST(PhysicalScene, PutsAnEnvironmentWhereNoLightIsStated) {
    nlohmann::json json = scene_with("{}", png({9, 9, 9, 255}, 1, 1));
    EXPECT_FALSE(read_physical_scene(json)->has_no_light);
    for (nlohmann::json& node : json["nodes"]) node.erase("extensions");
    const Result<Scene> dark = read_physical_scene(json);
    ASSERT_TRUE(dark) << to_text(dark.error().front());
    EXPECT_TRUE(dark->has_no_light);
    EXPECT_EQ(verdict(*dark, "reflection"), "in: the scene states no light: the studio stands in");
    json["scenes"][0]["extras"]["gobo"]["ambient"] = {0.1, 0.1, 0.1};
    EXPECT_FALSE(read_physical_scene(json)->has_no_light);
}

/// Of a scene without lights, in the studio, under a sky that nothing mirrors, and in the dark.
TEST(PhysicalScene, LeavesOutExtensionsThatNoLightShows) {
    struct Row {
        const char* effect;
        const char* studio;
        const char* sky;
        const char* dark;
    };
    const Row rows[] = {
        {"clearcoat", "in: clearcoatFactor of 1", "in: clearcoatFactor of 1", "no light is in"},
        {"sheen", "in: sheenColorFactor of 0.5", "in: sheenColorFactor of 0.5", "no light is in"},
        {"iridescence", "in: iridescenceFactor of 1", "no light is in", "no light is in"},
        {"anisotropy", "no light is in", "no light is in", "no light is in"},
    };
    nlohmann::json json = scene_with(R"({"extensions": {
        "KHR_materials_clearcoat": {"clearcoatFactor": 1}, "KHR_materials_sheen": {"sheenColorFactor": [0, 0.5, 0.25]},
        "KHR_materials_iridescence": {"iridescenceFactor": 1}, "KHR_materials_anisotropy": {"anisotropyStrength": 1}}})",
                                     png({9, 9, 9, 255}, 1, 1));
    for (nlohmann::json& node : json["nodes"]) node.erase("extensions");
    const Result<Scene> studio = read_physical_scene(json);
    nlohmann::json& of_gobo = json["scenes"][0]["extras"]["gobo"];
    of_gobo["ambient"] = {0.1, 0.1, 0.1};
    const Result<Scene> dark = read_physical_scene(json);
    of_gobo["probe"] = {{"kind", "hemisphere"}, {"sky", {1, 1, 1}}, {"ground", {0, 0, 0}}};
    const Result<Scene> sky = read_physical_scene(json);
    ASSERT_TRUE(studio && sky && dark);
    for (const Row& row : rows) {
        EXPECT_EQ(verdict(*studio, row.effect), row.studio) << row.effect;
        EXPECT_EQ(verdict(*sky, row.effect), row.sky) << row.effect;
        EXPECT_EQ(verdict(*dark, row.effect), row.dark) << row.effect;
    }
}

TEST(PhysicalScene, RefusesAPictureThatIsCutShort) {
    const std::string whole = jpeg(128);
    EXPECT_TRUE(decode_picture(whole));
    const auto cut = decode_picture(whole.substr(0, whole.size() - 4));
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().message, "is no JPEG that can be decoded: Premature end of JPEG file");
}

TEST(PhysicalScene, RefusesAPngThatIsCutShort) {
    std::vector<unsigned char> bytes;
    ASSERT_EQ(lodepng::encode(bytes, {1, 2, 3, 255}, 1, 1), 0U);
    const std::string whole(bytes.begin(), bytes.end());
    EXPECT_TRUE(decode_picture(whole));
    for (const std::size_t size : {std::size_t{8}, std::size_t{33}, std::size_t{45}, whole.size() - 12}) {
        const auto cut = decode_picture(whole.substr(0, size));
        ASSERT_FALSE(cut) << size;
        EXPECT_EQ(cut.error().message, "is a PNG that is cut short") << size;
    }
}

TEST(PhysicalScene, SaysWhatToDoAboutInks) {
    const auto refused = decode_picture(jpeg(128, false, JCS_CMYK));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "is a JPEG in CMYK, but RGB and grey are read");
    EXPECT_EQ(refused.error().help, "convert it (convert FILE.jpg -colorspace sRGB FILE.png)");
}

TEST(PhysicalScene, DrawsNormalsWithinTheDomainOfTheirScale) {
    struct Row {
        const char* scale;
        double drawn;
        const char* told;
    };
    const Row rows[] = {{"10", 10, nullptr},
                        {"-10", -10, nullptr},
                        {"100", 10, "normalTexture.scale 100 (it is drawn as 10)"},
                        {"-10.5", -10, "normalTexture.scale -10.5 (it is drawn as -10)"}};
    for (const Row& row : rows) {
        const Result<Scene> scene = read_physical_scene(
            scene_with(fmt::format(R"({{"normalTexture": {{"index": 0, "scale": {}}}}})", row.scale),
                       png({130, 128, 255, 255}, 1, 1)));
        ASSERT_TRUE(scene) << to_text(scene.error().front());
        const PhysicalMaterial& material = scene->materials[0].physical;
        EXPECT_EQ(material.normal_scale, row.drawn) << row.scale;
        std::vector<std::string> told;
        if (row.told != nullptr) told.emplace_back(row.told);
        EXPECT_EQ(material.not_drawn, told) << row.scale;
    }
}

TEST(PhysicalScene, RefusesASheenThatReflectsMoreThanItReceives) {
    const Result<Scene> scene = read_physical_scene(
        scene_with(R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 5, 0]}}})",
                   png({9, 9, 9, 9}, 1, 1)));
    ASSERT_FALSE(scene);
    EXPECT_EQ(to_text(scene.error().front()),
              "quad.gltf: error: materials[0].extensions.KHR_materials_sheen.sheenColorFactor holds a number "
              "that is not between 0 and 1\n");
}

TEST(PhysicalScene, ReadsHowPicturesAreMinified) {
    nlohmann::json json = scene_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                                     png({9, 9, 9, 255}, 1, 1));
    const auto filter = [&] { return read_physical_scene(json)->materials[0].physical.maps[0]->min_filter; };
    EXPECT_EQ(filter(), 9987) << "without a sampler";
    json["textures"][0]["sampler"] = 0;
    json["samplers"] = {nlohmann::json::object()};
    EXPECT_EQ(filter(), 9987) << "a sampler that states none";
    for (const int stated : {9728, 9729, 9984, 9985, 9986, 9987}) {
        json["samplers"][0]["minFilter"] = stated;
        EXPECT_EQ(filter(), stated);
    }
}

/// The quad, its lamp and its camera, each of which may hang below a hidden node.
TEST(PhysicalScene, LeavesOutWhatIsHidden) {
    struct Row {
        const char* name;
        std::size_t hidden;  ///< the node that is not visible
        std::size_t child;   ///< hangs below it
        std::size_t draws, lights;
        bool has_camera;
    };
    const Row rows[] = {{"the mesh", 0, 0, 0, 1, true},
                        {"the lamp", 1, 1, 1, 0, true},
                        {"a camera stays", 2, 2, 1, 1, true},
                        {"what hangs below", 0, 1, 0, 0, true}};
    for (const Row& row : rows) {
        nlohmann::json json = scene_with("{}", png({9, 9, 9, 255}, 1, 1));
        json["extensionsRequired"] = {"KHR_node_visibility"};
        json["nodes"][row.hidden]["extensions"]["KHR_node_visibility"]["visible"] = false;
        if (row.child != row.hidden) {
            json["nodes"][row.child]["extensions"]["KHR_node_visibility"]["visible"] = true;
            json["nodes"][row.hidden]["children"] = {row.child};
            json["scenes"][0]["nodes"] = {0, 2};
        }
        const Result<Scene> scene = read_physical_scene(json);
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        EXPECT_EQ(required_effects(*scene, {}, {}).size(), row.draws) << row.name;
        EXPECT_EQ(place_lights(*scene).size(), row.lights) << row.name;
        EXPECT_EQ(eye_of_cameras(*scene).has_value(), row.has_camera) << row.name;
    }
}

/// The lamp stands 2 above the middle of the quad.
TEST(PhysicalScene, TellsOnceWhatIsNotRead) {
    struct Row {
        const char* name;
        const char* patch;
        std::vector<std::string> told;
    };
    const Row rows[] = {
        {"nothing", "[]", {}},
        {"extensions of any kind",
         R"([{"op": "add", "path": "/extensionsUsed",
              "value": ["KHR_lights_punctual", "EXT_lights_image_based", "KHR_materials_volume", "ACME_fur"]},
             {"op": "add", "path": "/materials/0/extensions", "value": {"KHR_materials_volume": {}}}])",
         {"quad.gltf: not drawn: ACME_fur, EXT_lights_image_based, KHR_materials_volume"}},
        {"extensions whose place core glTF takes",
         R"([{"op": "add", "path": "/extensionsUsed",
              "value": ["EXT_texture_webp", "KHR_draco_mesh_compression", "KHR_xmp_json_ld"]}])",
         {}},
        {"a light of 0",
         R"([{"op": "add", "path": "/extensions/KHR_lights_punctual/lights/0/intensity", "value": 0}])",
         {"quad.gltf: nothing lights this scene"}},
        {"a black light",
         R"([{"op": "add", "path": "/extensions/KHR_lights_punctual/lights/0/color", "value": [0, 0, 0]}])",
         {"quad.gltf: nothing lights this scene"}},
        {"a black light and what emits",
         R"([{"op": "add", "path": "/extensions/KHR_lights_punctual/lights/0/color", "value": [0, 0, 0]},
             {"op": "add", "path": "/materials/0/emissiveFactor", "value": [0, 1, 0]}])",
         {}},
        {"no light and no reflection",
         R"([{"op": "remove", "path": "/nodes/1/extensions"},
             {"op": "add", "path": "/scenes/0/extras", "value": {"gobo": {"reflection": 0}}}])",
         {"quad.gltf: nothing lights this scene"}},
        {"no light at all: the studio", R"([{"op": "remove", "path": "/nodes/1/extensions"}])", {}},
        {"shadows of what is blended",
         R"([{"op": "add", "path": "/materials/0/alphaMode", "value": "BLEND"},
             {"op": "add", "path": "/extensions/KHR_lights_punctual/lights/0/extras",
              "value": {"gobo": {"shadow": true}}}])",
         {"quad.gltf: not drawn: shadows of 1 blended draw"}},
    };
    for (const Row& row : rows) {
        const nlohmann::json json =
            scene_with("{}", png({9, 9, 9, 255}, 1, 1)).patch(nlohmann::json::parse(row.patch));
        const Result<Scene> scene = read_physical_scene(json);
        ASSERT_TRUE(scene) << row.name << ": " << to_text(scene.error().front());
        const std::vector<Draw> draws = required_effects(*scene, {}, {});
        std::vector<std::optional<DrawKey>> keys(draws.size());
        for (std::size_t i = 0; i < draws.size(); ++i) {
            keys[i].emplace();
            for (const std::string& name : material_of(*scene, draws[i]).physical.not_drawn)
                keys[i]->missing.push_back(name + ": needed, but not yet in the family");
        }
        EXPECT_EQ(notes_on_scene(*scene, draws, keys), row.told) << row.name;
    }
}

TEST(PhysicalScene, RefusesAPictureOfManyScans) {
    const std::string whole = jpeg(128, true);
    EXPECT_TRUE(decode_picture(whole));
    const std::size_t last = whole.rfind("\xff\xda");
    std::string longer = whole.substr(0, last);
    for (int i = 0; i < 200; ++i) longer += whole.substr(last, whole.size() - 2 - last);
    const auto read = decode_picture(longer + whole.substr(whole.size() - 2));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "is no JPEG that can be decoded: it has more than 100 scans");
}

TEST(PhysicalScene, RefusesAPictureThatHoldsMoreThanItsSize) {
    std::vector<unsigned char> file, packed;
    ASSERT_EQ(lodepng::encode(file, {1, 2, 3, 255}, 1, 1), 0U);
    ASSERT_EQ(lodepng::compress(packed, std::vector<unsigned char>(1'000'000)), 0U);
    constexpr std::size_t before_texels = 8 + 25, end = 12;  // the signature and chunk IHDR, chunk IEND
    unsigned char* chunk = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(lodepng_chunk_create(&chunk, &size, packed.size(), "IDAT", packed.data()), 0U);
    std::string larger(file.begin(), file.begin() + before_texels);
    larger.append(chunk, chunk + size).append(file.end() - end, file.end());
    free(chunk);
    const auto read = decode_picture(larger);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message,
              "is no PNG that can be decoded: tried to decompress zlib or deflate data larger than desired "
              "max_output_size");
}

TEST(PhysicalScene, RefusesTextureCoordinatesBelowTheFirst) {
    const auto read = [](const char* set) {
        return read_physical_scene(scene_with(
            fmt::format(
                R"({{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0, "texCoord": {}}}}}}})", set),
            png({255, 255, 255, 255}, 1, 1)));
    };
    const Result<Scene> beyond = read("4294967296");
    ASSERT_TRUE(beyond);
    EXPECT_THAT(beyond->materials.front().physical.not_drawn,
                ElementsAre("baseColorTexture by texCoord 4294967296"));
    const Result<Scene> below = read("-1");
    ASSERT_FALSE(below);
    EXPECT_THAT(
        to_text(below.error().front()),
        HasSubstr(
            "materials[0].pbrMetallicRoughness.baseColorTexture.texCoord is -1, but must be at least 0"));
}

TEST(PhysicalScene, RefusesAnIndexOfRefractionThatNoMaterialHas) {
    const auto scene = [](const char* ior) {
        const std::string extension = R"({"KHR_materials_ior": {"ior": )" + std::string(ior) + "}}";
        return read_physical_scene(
            scene_with(R"({"extensions": )" + extension + "}", png({9, 9, 9, 9}, 1, 1)));
    };
    EXPECT_TRUE(scene("0")) << "glTF's sign for a reflectance of 1";
    EXPECT_TRUE(scene("1"));
    const auto refused = scene("0.5");
    ASSERT_FALSE(refused);
    EXPECT_EQ(to_text(refused.error().front()),
              "quad.gltf: error: materials[0].extensions.KHR_materials_ior.ior is 0.5, but must be 0 or at "
              "least 1\n");
}

}  // namespace
}  // namespace gobo::scene
