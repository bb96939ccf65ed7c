// What is read of scenes that are in order.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "scene/effects.hpp"
#include "scene/geometry.hpp"
#include "scene/read_scene.hpp"
#include "scene_support.hpp"

namespace gobo::scene {
namespace {

using Content = std::map<std::string, std::string, std::less<>>;

std::string text_of(const glm::dvec3& v) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z);
}

std::string text_of(const Box& box) {
    return fmt::format("{} to {}", text_of(box.low), text_of(box.high));
}

/// The bounds of the first draw.
std::string bounds_of(const Scene& scene) {
    const std::vector<Draw> draws = required_effects(scene, {}, {});
    if (draws.empty() || !draws.front().bounds) return "unknown";
    return text_of(*draws.front().bounds);
}

struct Placed {
    std::string name;
    std::string patch;
    std::string bounds;
};

class Bounds : public testing::TestWithParam<Placed> {};

TEST_P(Bounds, HoldThePrimitive) {
    EXPECT_EQ(bounds_of(read_patched(GetParam().patch)), GetParam().bounds);
}

std::string animated(std::string_view path, int output, std::string_view more = "") {
    return put("/animations/-", fmt::format(R"({{"samplers": [{{"input": 2, "output": {}{}}}],
        "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "{}"}}}}]}})",
                                            output, more, path));
}

INSTANTIATE_TEST_SUITE_P(
    Scene, Bounds,
    testing::Values(
        Placed{"at_rest", "[]", "-1 -1 0 to 1 1 0"},
        Placed{"moved", put("/nodes/0/translation", "[3, 0, 0]"), "2 -1 0 to 4 1 0"},
        Placed{"scaled", put("/nodes/0/scale", "[2, 3, 1]"), "-2 -3 0 to 2 3 0"},
        Placed{"mirrored", put("/nodes/0/scale", "[-2, 1, 1]"), "-2 -1 0 to 2 1 0"},
        Placed{"turned_an_eighth", put("/nodes/0/rotation", "[0, 0, 0.38268343, 0.92387953]"),
               "-1.414 -1.414 0 to 1.414 1.414 0"},
        Placed{"by_matrix", put("/nodes/0/matrix", "[2,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]"),
               "3 -1 0 to 7 1 0"},
        Placed{"below_a_parent",
               R"([{"op": "add", "path": "/nodes/1/children", "value": [0]},
                   {"op": "replace", "path": "/scenes/0/nodes", "value": [1, 2]}])",
               "-1 -1 2 to 1 1 2"},
        Placed{"sliding", animated("translation", 3), "-1 -1 -10 to 1 1 0"},
        Placed{"stepping", animated("translation", 3, R"(, "interpolation": "STEP")"), "-1 -1 -10 to 1 1 0"},
        // Scale from 0 to -10 along z only, of a quad without depth: nothing but x and y shrink to 0.
        Placed{"shrinking", animated("scale", 3), "-1 -1 0 to 1 1 0"},
        Placed{"sparse_shift",
               R"([{"op": "add", "path": "/accessors/0/sparse", "value": {"count": 1,
                    "indices": {"bufferView": 1, "componentType": 5123},
                    "values": {"bufferView": 2, "byteOffset": 20}}}])",
               "-1 -1 -10 to 1 1 0"},
        // Accessor 3 holds (0, 0, 0) and (0, 0, -10).
        Placed{"instanced", instanced(R"({"TRANSLATION": 3})"), "-1 -1 -10 to 1 1 0"},
        Placed{"instanced_flat", instanced(R"({"SCALE": 3})"), "0 0 0 to 0 0 0"},
        Placed{"instanced_under_a_scale",
               R"([{"op": "add", "path": "/nodes/0/scale", "value": [2, 1, 3]},
                   {"op": "add", "path": "/nodes/0/extensions",
                    "value": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 3}}}}])",
               "-2 -1 -30 to 2 1 0"},
        Placed{"morphed_at_rest",
               R"([{"op": "add", "path": "/meshes/0/primitives/0/targets", "value": [{"POSITION": 0}]},
                   {"op": "add", "path": "/meshes/0/weights", "value": [0.5]}])",
               "-1.5 -1.5 0 to 1.5 1.5 0"},
        Placed{"morphed_by_node",
               R"([{"op": "add", "path": "/meshes/0/primitives/0/targets", "value": [{"POSITION": 0}]},
                   {"op": "add", "path": "/nodes/0/weights", "value": [2]}])",
               "-3 -3 0 to 3 3 0"},
        // The weight runs from 0 to 1: the times serve as weights.
        Placed{"morphed_by_animation",
               R"([{"op": "add", "path": "/meshes/0/primitives/0/targets", "value": [{"POSITION": 0}]},
                   {"op": "add", "path": "/animations/-", "value": {"samplers": [{"input": 2, "output": 2}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}}])",
               "-2 -2 0 to 2 2 0"},
        Placed{"skinned_without_weights",
               R"([{"op": "add", "path": "/skins/-", "value": {"joints": [1]}},
                   {"op": "add", "path": "/nodes/0/skin", "value": 0}])",
               "unknown"}),
    [](const auto& row) { return row.param.name; });

/// A quaternion animation turns by any angle: the box must hold the quad at every angle.
TEST(SceneMotion, RotatingBoundsHoldEveryAngle) {
    Scene scene = read_patched("[]");
    scene.nodes[0].motion =
        Motion{{glm::dvec3(0), glm::dvec3(0)}, {glm::dvec3(1), glm::dvec3(1)}, true, true, {}};
    const auto bounds = world_bounds(scene, 0, scene.meshes[0].primitives[0]);
    ASSERT_TRUE(bounds);
    EXPECT_NEAR(bounds->high.x, std::sqrt(2.0), 1e-12) << "a corner's distance from the origin";
    EXPECT_NEAR(bounds->low.z, -std::sqrt(2.0), 1e-12);
}

/// A cubic spline from 0 to 1 with tangents of 30 rises far above its keyframes.
TEST(SceneMotion, CubicSplinesStayWithinTheBoundsBetweenKeyframes) {
    nlohmann::json json = quad_scene();
    std::string buffer =
        quad_buffer() + float_bytes({0, 0, 0, 0, 0, 0, 30, 0, 0}) + float_bytes({30, 0, 0, 1, 0, 0, 0, 0, 0});
    json["buffers"][0]["byteLength"] = buffer.size();
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 92}, {"byteLength", 72}});
    json["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 6}, {"type", "VEC3"}});
    json["animations"].push_back(nlohmann::json::parse(R"({
        "samplers": [{"input": 2, "output": 4, "interpolation": "CUBICSPLINE"}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]})"));
    const MemoryFileSystem files(Content{{"quad.gltf", json.dump()}, {"quad.bin", buffer}});
    const Result<Scene> scene = read_scene(files, "quad.gltf");
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    const Motion& motion = *scene->nodes[0].motion;
    for (int i = 0; i <= 100; ++i) {
        const double t = i / 100.0;  // Hermite's polynomials (glTF 2.0 specification, appendix C)
        const double x =
            (t * t * t - 2 * t * t + t) * 30 + (3 * t * t - 2 * t * t * t) + (t * t * t - t * t) * 30;
        EXPECT_GE(x, motion.translation.low.x) << t;
        EXPECT_LE(x, motion.translation.high.x) << t;
    }
}

/// A skinned quad follows its joint, not its node.
TEST(SceneMotion, SkinnedBoundsFollowTheJoints) {
    nlohmann::json json = quad_scene();
    std::string buffer = quad_buffer() + std::string(16, '\0');
    for (int i = 0; i < 4; ++i) buffer += float_bytes({1, 0, 0, 0});
    json["buffers"][0]["byteLength"] = buffer.size();
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 92}, {"byteLength", 16}});
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 108}, {"byteLength", 64}});
    json["accessors"].push_back({{"bufferView", 3}, {"componentType", 5121}, {"count", 4}, {"type", "VEC4"}});
    json["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
    auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = 4;
    attributes["WEIGHTS_0"] = 5;
    json["skins"].push_back({{"joints", {1}}});
    json["nodes"][0]["skin"] = 0;
    json["nodes"][0]["translation"] = {100, 0, 0};
    const MemoryFileSystem files(Content{{"quad.gltf", json.dump()}, {"quad.bin", buffer}});
    const Result<Scene> scene = read_scene(files, "quad.gltf");
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    EXPECT_EQ(bounds_of(*scene), "-1 -1 2 to 1 1 2");
}

TEST(SceneReading, ContainersAndDataUrisHoldTheSameAsFiles) {
    nlohmann::json inside = quad_scene();
    inside["buffers"][0].erase("uri");
    nlohmann::json short_uri = quad_scene();
    short_uri["buffers"][0] = {{"byteLength", 48},
                               {"uri",
                                "data:application/octet-stream;base64,"
                                "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAA"}};
    short_uri["bufferViews"] = {{{"buffer", 0}, {"byteLength", 48}}};
    short_uri["accessors"].erase(1);
    short_uri["accessors"].erase(1);
    short_uri["accessors"].erase(1);
    short_uri["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}, {"mode", 6}};
    const MemoryFileSystem files(
        Content{{"file.glb", container_of(inside.dump(), quad_buffer())}, {"uri.gltf", short_uri.dump()}});
    for (const std::string path : {"file.glb", "uri.gltf"}) {
        const Result<Scene> scene = read_scene(files, path);
        ASSERT_TRUE(scene) << to_text(scene.error().front());
        EXPECT_EQ(bounds_of(*scene), "-1 -1 0 to 1 1 0") << path;
        EXPECT_EQ(scene->meshes[0].primitives[0].indices.size(), 6U) << path;
        EXPECT_EQ(scene->files, std::vector<std::string>{path});
    }
}

TEST(SceneReading, BufferFilesAreNamedRelativeToTheScene) {
    nlohmann::json json = quad_scene();
    json["buffers"][0]["uri"] = "my%20quad.bin";
    const MemoryFileSystem files(
        Content{{"rooms/quad.gltf", json.dump()}, {"rooms/my quad.bin", quad_buffer()}});
    const Result<Scene> scene = read_scene(files, "rooms/quad.gltf");
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    EXPECT_EQ(scene->files, (std::vector<std::string>{"rooms/quad.gltf", "rooms/my quad.bin"}));
}

TEST(SceneReading, WarnsOfConesThatTheSpecificationForbids) {
    const auto warnings_of = [](const std::string& light) {
        return to_text(read_patched(put("/extensions/KHR_lights_punctual/lights/0", light)).warnings);
    };
    EXPECT_EQ(warnings_of(R"({"type": "spot"})"),
              "quad.gltf: warning: extensions.KHR_lights_punctual.lights[0] is a spot light without 'spot'\n"
              "  help: its cone reaches 45 degrees from its axis\n");
    EXPECT_EQ(
        warnings_of(R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}})"),
        "quad.gltf: warning: extensions.KHR_lights_punctual.lights[0].spot must have innerConeAngle, 0.5, "
        "below outerConeAngle, 0.5\n  help: its edge is hard\n");
    EXPECT_EQ(warnings_of(R"({"type": "spot", "spot": {"innerConeAngle": 0.4, "outerConeAngle": 0.5}})"), "");
}

TEST(SceneReading, MissingNormalsAreComputedFlat) {
    const Scene scene = read_patched("[]");
    const Primitive& quad = scene.meshes[0].primitives[0];
    ASSERT_EQ(quad.positions.size(), 6U) << "no vertex is shared";
    ASSERT_EQ(quad.normals.size(), 6U);
    for (const glm::vec3& normal : quad.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

struct Topologies {
    std::string name;
    int mode;
    std::string excluded;
    std::size_t indices;
};

class Modes : public testing::TestWithParam<Topologies> {};

TEST_P(Modes, AreTrianglesOrOut) {
    const Scene scene = read_patched(put("/meshes/0/primitives/0/mode", std::to_string(GetParam().mode)));
    const std::vector<Draw> draws = required_effects(scene, {}, {});
    ASSERT_EQ(draws.size(), 1U);
    EXPECT_EQ(draws[0].excluded, GetParam().excluded);
    EXPECT_EQ(scene.meshes[0].primitives[0].indices.size(), GetParam().indices);
}

INSTANTIATE_TEST_SUITE_P(Scene, Modes,
                         testing::Values(Topologies{"points", 0, "its primitives are points", 6},
                                         Topologies{"lines", 1, "its primitives are lines", 6},
                                         Topologies{"line_loop", 2, "its primitives are lines", 6},
                                         Topologies{"line_strip", 3, "its primitives are lines", 6},
                                         Topologies{"triangles", 4, "", 6}, Topologies{"strip", 5, "", 12},
                                         Topologies{"fan", 6, "", 12}),
                         [](const auto& row) { return row.param.name; });

struct Rule {
    std::string name;
    std::string model;  ///< pbrMetallicRoughness
    glm::dvec3 diffuse;
    glm::dvec3 specular;
    double shininess;
};

class MaterialRule : public testing::TestWithParam<Rule> {};

TEST_P(MaterialRule, GivesDiffuseSpecularAndShininess) {
    const Scene scene = read_patched(put("/materials/0/pbrMetallicRoughness", GetParam().model));
    const Material& material = scene.materials[0];
    constexpr double rounding = 1e-9;  // a dozen operations on numbers below 1e4
    EXPECT_NEAR(glm::distance(material.diffuse, GetParam().diffuse), 0, rounding)
        << text_of(material.diffuse);
    EXPECT_NEAR(glm::distance(material.specular, GetParam().specular), 0, rounding)
        << text_of(material.specular);
    EXPECT_NEAR(material.shininess, GetParam().shininess, rounding);
}

INSTANTIATE_TEST_SUITE_P(
    Scene, MaterialRule,
    testing::Values(
        Rule{"dielectric",
             R"({"metallicFactor": 0, "roughnessFactor": 0.5, "baseColorFactor": [1, 0.5, 0, 1]})",
             {1, 0.5, 0},
             {0.04, 0.04, 0.04},
             30},
        Rule{"metal",
             R"({"metallicFactor": 1, "roughnessFactor": 0.5, "baseColorFactor": [1, 0.5, 0, 1]})",
             {0, 0, 0},
             {1, 0.5, 0},
             30},
        Rule{"half_metal",
             R"({"metallicFactor": 0.5, "roughnessFactor": 0.5, "baseColorFactor": [1, 0.5, 0, 1]})",
             {0.5, 0.25, 0},
             {0.52, 0.27, 0.02},
             30},
        Rule{"mirror", R"({"metallicFactor": 1, "roughnessFactor": 0})", {0, 0, 0}, {1, 1, 1}, 7998},
        Rule{"rough_metal", "{}", {1, 1, 1}, {0, 0, 0}, 0},
        Rule{"rough_dielectric",
             R"({"metallicFactor": 0, "baseColorFactor": [0.5, 0.5, 0.5, 1]})",
             {0.54, 0.54, 0.54},
             {0, 0, 0},
             0}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::scene
