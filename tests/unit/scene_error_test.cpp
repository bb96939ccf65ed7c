// Broken scenes: each has one error, told whole.
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/read_scene.hpp"
#include "scene_support.hpp"

namespace gobo::scene {
namespace {

using Content = std::map<std::string, std::string, std::less<>>;

std::string error_of(const Result<Scene>& scene) {
    return scene ? "no error" : to_text(scene.error());
}

struct Broken {
    std::string name;
    std::string patch;
    std::string error;  ///< after "quad.gltf: error: "
};

class BrokenScenes : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScenes, HaveOneClearError) {
    const Result<Scene> scene = read_json(patched_scene(GetParam().patch));
    EXPECT_EQ(error_of(scene), "quad.gltf: error: " + GetParam().error + "\n");
    ASSERT_FALSE(scene);
    EXPECT_EQ(exit_status(scene.error()), 1);
}

/// A masked material whose base colour is that image.
std::string masked(std::string_view image) {
    return fmt::format(
        R"([{{"op": "add", "path": "/images", "value": [{}]}},
            {{"op": "add", "path": "/textures", "value": [{{"source": 0}}]}},
            {{"op": "add", "path": "/materials/0/alphaMode", "value": "MASK"}},
            {{"op": "add", "path": "/materials/0/pbrMetallicRoughness/baseColorTexture", "value": {{"index": 0}}}}])",
        image);
}

INSTANTIATE_TEST_SUITE_P(
    File, BrokenScenes,
    testing::Values(
        Broken{"no_asset", take("/asset"),
               "asset is missing\n  help: a glTF file begins with {\"asset\": {\"version\": \"2.0\"}}"},
        Broken{"old_version", put("/asset/version", R"("1.0")"),
               "asset.version is '1.0', but only glTF 2 is read"},
        Broken{"newer_needed", put("/asset/minVersion", R"("2.1")"),
               "asset.minVersion is '2.1', but only glTF 2.0 is read"},
        Broken{
            "extension_required", put("/extensionsRequired", R"(["KHR_draco_mesh_compression"])"),
            "extensionsRequired[0] is KHR_draco_mesh_compression, which gobo does not read\n  help: export "
            "without it; read are EXT_mesh_gpu_instancing, KHR_lights_punctual, "
            "KHR_materials_emissive_strength, "
            "KHR_materials_specular, "
            "KHR_materials_unlit, KHR_mesh_quantization, KHR_node_visibility, KHR_texture_transform"},
        Broken{
            "light_too_bright", put("/extensions/KHR_lights_punctual/lights/0/intensity", "1e38"),
            "extensions.KHR_lights_punctual.lights[0].intensity is 1e+38, but must be between 0 and 1e+12"},
        Broken{"colour_too_bright", put("/extensions/KHR_lights_punctual/lights/0/color", "[0, 1e30, 0]"),
               "extensions.KHR_lights_punctual.lights[0].color holds a number above 1e+12"},
        Broken{"wrap_unknown", put("/samplers", R"([{"wrapS": 5}])"),
               "samplers[0].wrapS is 5, but must be one of 10497, 33071, 33648"},
        Broken{"magnified_unknown", put("/samplers", R"([{"magFilter": 9986}])"),
               "samplers[0].magFilter is 9986, but must be one of 9728, 9729"},
        Broken{"minified_unknown", put("/samplers", R"([{"wrapT": 10497}, {"minFilter": 9999}])"),
               "samplers[1].minFilter is 9999, but must be one of 9728, 9729, 9984, 9985, 9986, 9987"},
        Broken{"nodes_no_array", put("/nodes", R"("three")"), "nodes must be an array, not a string"},
        Broken{"node_no_object", put("/nodes/0", "7"), "nodes[0] must be an object, not a number"},
        Broken{"scene_out_of_range", put("/scene", "4"),
               "scene is 4, but the file has 1 scenes\n  help: indices run from 0 to 0"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Nodes, BrokenScenes,
    testing::Values(
        Broken{"mesh_out_of_range", put("/nodes/0/mesh", "3"),
               "nodes[0].mesh is 3, but the file has 1 meshes\n  help: indices run from 0 to 0"},
        Broken{"mesh_negative", put("/nodes/0/mesh", "-1"),
               "nodes[0].mesh is -1, but the file has 1 meshes\n  help: indices run from 0 to 0"},
        Broken{"mesh_no_number", put("/nodes/0/mesh", R"("cube")"),
               "nodes[0].mesh must be a whole number, not a string"},
        Broken{"mesh_half", put("/nodes/0/mesh", "0.5"), "nodes[0].mesh must be a whole number, not 0.5"},
        Broken{"light_out_of_range", put("/nodes/1/extensions/KHR_lights_punctual/light", "1"),
               "nodes[1].extensions.KHR_lights_punctual.light is 1, but the file has 1 lights\n  help: "
               "indices run "
               "from 0 to 0"},
        Broken{"own_child", put("/nodes/0/children", "[0]"),
               "nodes[0] is its own ancestor: the nodes form a cycle"},
        Broken{"cycle_of_two",
               R"([{"op": "add", "path": "/nodes/0/children", "value": [1]},
                   {"op": "add", "path": "/nodes/1/children", "value": [0]}])",
               "nodes[0] is its own ancestor: the nodes form a cycle"},
        Broken{"two_parents",
               R"([{"op": "add", "path": "/nodes/0/children", "value": [2]},
                   {"op": "add", "path": "/nodes/1/children", "value": [2]}])",
               "nodes[2] is a child of both node 0 and node 1\n  help: a node has at most one parent; let "
               "two nodes "
               "share a mesh instead"},
        Broken{"scene_lists_child", put("/nodes/0/children", "[2]"),
               "scenes[0].nodes[2] is node 2, which is a child of node 0\n  help: a scene lists root nodes "
               "only"},
        Broken{"short_translation", put("/nodes/0/translation", "[1, 2]"),
               "nodes[0].translation must hold 3 numbers, not 2"},
        Broken{"zero_rotation", put("/nodes/0/rotation", "[0, 0, 0, 0]"),
               "nodes[0].rotation is not a rotation: its length must be 1"},
        Broken{"long_rotation", put("/nodes/0/rotation", "[1, 1, 1, 1]"),
               "nodes[0].rotation is not a rotation: its length must be 1"},
        Broken{"visibility_no_truth",
               put("/nodes/0/extensions", R"({"KHR_node_visibility": {"visible": 0}})"),
               "nodes[0].extensions.KHR_node_visibility.visible must be true or false, not a number"},
        Broken{"projective_matrix", put("/nodes/0/matrix", "[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]"),
               "nodes[0].matrix is not an affine transform: its last row must be 0 0 0 1"},
        Broken{"matrix_and_scale",
               R"([{"op": "add", "path": "/nodes/0/matrix", "value": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},
                   {"op": "add", "path": "/nodes/0/scale", "value": [1, 1, 1]}])",
               "nodes[0] has both matrix and scale"},
        Broken{"absurdly_far", put("/nodes/0/translation", "[1e200, 0, 0]"),
               "nodes[0] is transformed beyond 1e+30 units, or not finitely"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Accessors, BrokenScenes,
    testing::Values(
        Broken{"view_beyond_buffer", put("/bufferViews/2/byteLength", "33"),
               "bufferViews[2] spans 33 bytes from byte 60, but buffers[0] holds 92 bytes"},
        Broken{"view_offset_wraps", put("/bufferViews/2/byteOffset", "9007199254740991"),
               "bufferViews[2] spans 32 bytes from byte 9007199254740991, but buffers[0] holds 92 bytes"},
        Broken{"negative_offset", put("/bufferViews/2/byteOffset", "-4"),
               "bufferViews[2] spans 32 bytes from byte -4, but buffers[0] holds 92 bytes"},
        Broken{"stride_of_three", put("/bufferViews/0/byteStride", "3"),
               "bufferViews[0].byteStride is 3, but must be a multiple of 4 from 4 to 252"},
        Broken{"stride_too_small", put("/bufferViews/0/byteStride", "8"),
               "accessors[0] has elements of 12 bytes, but bufferViews[0].byteStride is 8"},
        Broken{"count_beyond_view", put("/accessors/0/count", "5"),
               "accessors[0] asks for 5 elements, but bufferViews[0] has room for 4"},
        Broken{"count_absurd", put("/accessors/0/count", "9007199254740991"),
               "accessors[0] asks for 9007199254740991 elements, but bufferViews[0] has room for 4"},
        Broken{"count_zero", put("/accessors/0/count", "0"),
               "accessors[0].count is 0, but must be at least 1"},
        Broken{"zeros_without_end",
               R"([{"op": "remove", "path": "/accessors/0/bufferView"},
                   {"op": "replace", "path": "/accessors/0/count", "value": 1000000000000}])",
               "accessors[0] has 1000000000000 elements: the scene would hold more than 67108864 numbers"},
        Broken{"odd_offset", put("/accessors/0/byteOffset", "2"),
               "accessors[0].byteOffset is 2, but must be a multiple of 4"},
        Broken{"unknown_component", put("/accessors/0/componentType", "5124"),
               "accessors[0].componentType is 5124, but must be one of 5120, 5121, 5122, 5123, 5125, 5126"},
        Broken{"unknown_shape", put("/accessors/0/type", R"("VEC5")"),
               "accessors[0].type is 'VEC5', which is unknown\n  help: did you mean 'VEC2'?"},
        Broken{"no_shape", take("/accessors/0/type"), "accessors[0].type is missing"},
        Broken{
            "sparse_too_many",
            put("/accessors/0/sparse",
                R"({"count": 5, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})"),
            "accessors[0].sparse.count is 5, but must be from 1 to 4"},
        Broken{
            "sparse_unordered",
            put("/accessors/0/sparse",
                R"({"count": 4, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})"),
            "accessors[0] has sparse indices that do not rise from 0 to 3: 0 after 2"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Meshes, BrokenScenes,
    testing::Values(
        Broken{"no_primitives", put("/meshes/0/primitives", "[]"),
               "meshes[0].primitives must hold at least one primitive"},
        Broken{"no_attributes", take("/meshes/0/primitives/0/attributes"),
               "meshes[0].primitives[0].attributes is missing"},
        Broken{"compressed_alone",
               R"([{"op": "remove", "path": "/accessors/0/bufferView"},
                   {"op": "add", "path": "/meshes/0/primitives/0/extensions",
                    "value": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}])",
               "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression holds what gobo does not read: "
               "the mesh is nowhere else\n  help: export the mesh uncompressed"},
        Broken{"unknown_mode", put("/meshes/0/primitives/0/mode", "7"),
               "meshes[0].primitives[0].mode is 7, but must be between 0 and 6"},
        Broken{"material_out_of_range", put("/meshes/0/primitives/0/material", "1"),
               "meshes[0].primitives[0].material is 1, but the file has 1 materials\n  help: indices run "
               "from 0 to "
               "0"},
        Broken{"positions_of_scalars", put("/meshes/0/primitives/0/attributes/POSITION", "2"),
               "meshes[0].primitives[0].attributes.POSITION names accessors[2], which holds SCALAR of float, "
               "not VEC3 "
               "of float or byte or unsigned byte or short or unsigned short"},
        Broken{"fewer_normals", put("/meshes/0/primitives/0/attributes/NORMAL", "3"),
               "meshes[0].primitives[0].attributes.NORMAL has 2 elements, but there are 4 positions"},
        Broken{
            "indices_of_floats", put("/meshes/0/primitives/0/indices", "2"),
            "meshes[0].primitives[0].indices names accessors[2], which holds SCALAR of float, not SCALAR of "
            "unsigned byte or unsigned short or unsigned int"},
        Broken{"index_beyond_vertices", R"([{"op": "replace", "path": "/accessors/0/count", "value": 3}])",
               "meshes[0].primitives[0].indices names vertex 3 in element 5, but there are 3"},
        Broken{"weights_without_targets", put("/meshes/0/weights", "[1]"),
               "meshes[0].weights must hold 0 numbers, not 1"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Others, BrokenScenes,
    testing::Values(
        Broken{"negative_range", put("/extensions/KHR_lights_punctual/lights/0/range", "-1"),
               "extensions.KHR_lights_punctual.lights[0].range is -1, but must be above 0"},
        Broken{"unknown_light", put("/extensions/KHR_lights_punctual/lights/0/type", R"("area")"),
               "extensions.KHR_lights_punctual.lights[0].type is 'area', which is unknown\n  help: known: "
               "directional, point, spot"},
        Broken{"inner_beyond_outer",
               put("/extensions/KHR_lights_punctual/lights/0",
                   R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.4}})"),
               "extensions.KHR_lights_punctual.lights[0].spot.innerConeAngle is 0.5, wider than "
               "outerConeAngle, 0.4"},
        Broken{"flat_camera", put("/cameras/0/perspective/yfov", "0"),
               "cameras[0].perspective.yfov is 0, but must be an angle between 0 and pi"},
        Broken{"roughness_of_two", put("/materials/0/pbrMetallicRoughness/roughnessFactor", "2"),
               "materials[0].pbrMetallicRoughness.roughnessFactor is 2, but must be between 0 and 1"},
        Broken{"unknown_alpha_mode", put("/materials/0/alphaMode", R"("MASKED")"),
               "materials[0].alphaMode is 'MASKED', which is unknown\n  help: did you mean 'MASK'?"},
        Broken{"unknown_extra", put("/scenes/0/extras", R"({"gobo": {"fogg": {}}})"),
               "scenes[0].extras.gobo.fogg is unknown\n  help: did you mean 'fog'?"},
        Broken{"fog_without_kind", put("/scenes/0/extras", R"({"gobo": {"fog": {"near": 1}}})"),
               "scenes[0].extras.gobo.fog.kind is missing"},
        Broken{"too_many_levels", put("/materials/0/extras", R"({"gobo": {"toon": 65}})"),
               "materials[0].extras.gobo.toon is 65, but must be between 0 and 64 levels"},
        Broken{"skin_without_joints", put("/skins", R"([{"joints": []}])"),
               "skins[0].joints must name at least one node"},
        Broken{"animated_matrix",
               R"([{"op": "add", "path": "/nodes/0/matrix", "value": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},
                   {"op": "add", "path": "/animations/-", "value": {"samplers": [{"input": 2, "output": 3}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}}])",
               "animations[0].channels[0].target animates nodes[0], which has a matrix"},
        Broken{"too_few_keyframes", put("/animations/-", R"({"samplers": [{"input": 2, "output": 0}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]})"),
               "animations[0].samplers[0].output has 4 elements, but 2 keyframes need 2"},
        Broken{"data_not_base64", put("/buffers/0/uri", R"("data:application/octet-stream;base64,@@@@")"),
               "buffers[0].uri is a data URI whose base64 holds a character that is none of its digits"},
        Broken{"buffer_elsewhere", put("/buffers/0/uri", R"("https://example.org/quad.bin")"),
               "buffers[0].uri is 'https://example.org/quad.bin'\n  help: buffers and pictures are data "
               "URIs or paths "
               "relative "
               "to the file"},
        Broken{"texture_out_of_range", put("/materials/0/normalTexture", R"({"index": 3})"),
               "materials[0].normalTexture.index is 3, but the file has 0 textures"},
        Broken{"image_out_of_range", put("/textures", R"([{"source": 1}])"),
               "textures[0].source is 1, but the file has 0 images"},
        Broken{"picture_cut_short", masked(R"({"uri": "data:;base64,iVBORw0KGgoAAAA="})"),
               "images[0] is a PNG that is cut short"},
        Broken{"picture_nowhere", masked("{}"), "images[0] has neither uri nor bufferView"},
        Broken{"picture_twice", masked(R"({"uri": "quad.bin", "bufferView": 0})"),
               "images[0] has both uri and bufferView\n  help: leave one out"},
        Broken{"emits_more_than_1", put("/materials/0/emissiveFactor", "[0, 2, 0]"),
               "materials[0].emissiveFactor holds a number that is not between 0 and 1\n  help: "
               "KHR_materials_emissive_strength states more"},
        Broken{"instances_of_two_sizes", instanced(R"({"TRANSLATION": 0, "SCALE": 3})"),
               "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE has 2 elements, but there are 4 "
               "instances"},
        Broken{"instances_by_numbers", instanced(R"({"TRANSLATION": 2})"),
               "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION names accessors[2], which "
               "holds SCALAR of float, not VEC3 of float or byte or short"},
        Broken{"instances_of_a_skin",
               R"([{"op": "add", "path": "/skins", "value": [{"joints": [0]}]},
                   {"op": "add", "path": "/nodes/0/skin", "value": 0},
                   {"op": "add", "path": "/nodes/0/extensions",
                    "value": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}])",
               "nodes[0].extensions.EXT_mesh_gpu_instancing stands beside a skin: gobo draws no skinned "
               "instances\n  help: export each instance as a node of its own"},
        Broken{"zeros_without_end",
               put("/accessors/0", R"({"componentType": 5126, "count": 2000000, "type": "VEC3"})"),
               "accessors[0] has 2000000 elements without a buffer view: more than 4194304 zeros"},
        Broken{"probe_without_kind", put("/scenes/0/extras", R"({"gobo": {"probe": {"sky": [1, 1, 1]}}})"),
               "scenes[0].extras.gobo.probe.kind is missing"},
        Broken{"too_few_coefficients",
               put("/scenes/0/extras",
                   R"({"gobo": {"probe": {"kind": "spherical_harmonics", "coefficients": [[1, 1, 1]]}}})"),
               "scenes[0].extras.gobo.probe.coefficients must hold 9 colours, not 1"},
        Broken{"quality_no_name", put("/scenes/0/extras", R"({"gobo": {"quality": {"shading": 1}}})"),
               "scenes[0].extras.gobo.quality.shading must be a string, not a number"},
        Broken{"buffer_too_short", put("/buffers/0/byteLength", "93"),
               "buffers[0] holds 92 bytes, but its byteLength is 93"}),
    [](const auto& row) { return row.param.name; });

TEST(SceneErrors, MissingBufferFileIsAFaultOfTheFile) {
    const MemoryFileSystem files(Content{{"rooms/quad.gltf", quad_scene().dump()}});
    const Result<Scene> scene = read_scene(files, "rooms/quad.gltf");
    EXPECT_EQ(error_of(scene),
              "rooms/quad.bin: error: cannot be read: No such file or directory\n  help: buffers[0].uri of "
              "rooms/quad.gltf names it\n");
    EXPECT_EQ(exit_status(scene.error()), 3);
}

/// Each draw is judged by each light.
TEST(SceneErrors, DrawsAndLightsHaveABound) {
    nlohmann::json json = quad_scene();
    for (int i = 0; i < 2000; ++i) {
        json["scenes"][0]["nodes"].push_back(json["nodes"].size());
        json["nodes"].push_back({{"mesh", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    }
    const std::string text = error_of(read_json(json));
    EXPECT_NE(text.find("more than 2000000 pairs of them\n  help: split the scene"), std::string::npos)
        << text;
}

TEST(SceneErrors, MissingPictureIsAFaultOfTheFile) {
    const Result<Scene> scene = read_json(patched_scene(masked(R"({"uri": "leaf.png"})")));
    EXPECT_EQ(error_of(scene),
              "leaf.png: error: cannot be read: No such file or directory\n  help: images[0].uri of "
              "quad.gltf names it\n");
    EXPECT_EQ(exit_status(scene.error()), 3);
}

TEST(SceneErrors, NumbersThatAreNotFiniteAreNamed) {
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        std::string buffer = quad_buffer();
        buffer.replace(12, 4, float_bytes({bad}));
        const MemoryFileSystem files(Content{{"quad.gltf", quad_scene().dump()}, {"quad.bin", buffer}});
        EXPECT_EQ(
            error_of(read_scene(files, "quad.gltf")),
            "quad.gltf: error: meshes[0].primitives[0].attributes.POSITION is not finite in element 1 of "
            "accessors[0]\n");
    }
}

struct Cut {
    std::string name;
    std::string content;
    std::string error;
};

class CutFiles : public testing::TestWithParam<Cut> {};

TEST_P(CutFiles, SaySo) {
    const MemoryFileSystem files(Content{{"cut.glb", GetParam().content}});
    EXPECT_EQ(error_of(read_scene(files, "cut.glb")), GetParam().error + "\n");
}

std::string whole() {
    nlohmann::json scene = quad_scene();
    scene["buffers"][0].erase("uri");
    return container_of(scene.dump(), quad_buffer());
}

INSTANTIATE_TEST_SUITE_P(
    SceneErrors, CutFiles,
    testing::Values(
        Cut{"empty", "", "cut.glb:1:1: error: this is not JSON: it is empty"},
        Cut{"open_brace", "{\n  \"asset\": ",
            "cut.glb:2:12: error: this is not JSON: syntax error while parsing value - unexpected end of "
            "input; "
            "expected '[', '{', or a literal\n      \"asset\": \n               ^"},
        Cut{"no_object", "[]", "cut.glb: error: this is not glTF: its root is an array, not an object"},
        Cut{"magic_only", "glTF", "cut.glb: error: this container is cut short: it has no whole header"},
        Cut{"header_only", whole().substr(0, 12),
            "cut.glb: error: this container is cut short: its header says 1180 bytes, but there are 12"},
        Cut{"first_half", whole().substr(0, 800),
            "cut.glb: error: this container is cut short: its header says 1180 bytes, but there are 800"},
        Cut{"chunk_too_long", whole().replace(12, 4, "\xFF\xFF\xFF\x7F"),
            "cut.glb: error: this container is cut short: the chunk at byte 12 should have 2147483647 bytes, "
            "but only "
            "1160 follow"},
        Cut{"length_below_the_header", whole().replace(8, 4, std::string("\x0b\0\0\0", 4)),
            "cut.glb: error: this container says in its header that it has 11 bytes, but the header alone "
            "has "
            "12"},
        Cut{"version_1", whole().replace(4, 1, "\x01"),
            "cut.glb: error: this container has version 1, but only version 2 is read"}),
    [](const auto& row) { return row.param.name; });

/// Every prefix of a container and of a text, and every byte of a container changed: an error or a scene, no
/// crash.
TEST(SceneErrors, NoPrefixAndNoChangedByteCrashes) {
    const std::string container = whole();
    int read = 0;
    const auto try_reading = [&](const std::string& content) {
        const MemoryFileSystem files(Content{{"any.glb", content}});
        const Result<Scene> scene = read_scene(files, "any.glb");
        read += scene ? 1 : 0;
        if (!scene) {
            EXPECT_EQ(scene.error().size(), 1U);
        }
    };
    for (std::size_t size = 0; size < container.size(); ++size) try_reading(container.substr(0, size));
    EXPECT_EQ(read, 0) << "no prefix is whole";
    for (std::size_t i = 0; i < container.size(); ++i) {
        for (const char byte : {'\0', '9', '-', '\xFF'}) {
            std::string changed = container;
            changed[i] = byte;
            try_reading(changed);
        }
    }
    EXPECT_GT(read, 0) << "names may change";
}

}  // namespace
}  // namespace gobo::scene
