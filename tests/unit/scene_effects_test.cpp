// Which effects draws need: every rule with a row of its own, in and out.
#include <algorithm>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <lodepng.h>

#include "scene/effects.hpp"
#include "scene/geometry.hpp"
#include "scene_support.hpp"

namespace gobo::scene {
namespace {

/// "in, why" or "out, why" of the quad's effect of that name.
std::string verdict(const Scene& scene, const std::string& name) {
    for (const Draw& draw : required_effects(scene, eye_of_cameras(scene), {})) {
        for (const Effect& effect : draw.effects)
            if (effect.name == name) return fmt::format("{}, {}", effect.is_in ? "in" : "out", effect.reason);
    }
    return "no such effect";
}

struct Judged {
    std::string name;
    std::string patch;
    std::string effect;
    std::string verdict;
};

class Effects : public testing::TestWithParam<Judged> {};

TEST_P(Effects, AreJudged) {
    EXPECT_EQ(verdict(read_patched(GetParam().patch), GetParam().effect), GetParam().verdict);
}

/// The light of the scene, replaced; its node, replaced likewise where `node` is not empty.
std::string light(std::string_view members, std::string_view node = "") {
    std::string patch = fmt::format(
        R"([{{"op": "replace", "path": "/extensions/KHR_lights_punctual/lights/0", "value": {}}})", members);
    if (!node.empty()) {
        patch += fmt::format(
            R"(, {{"op": "replace", "path": "/nodes/1", "value": {{"extensions": {{"KHR_lights_punctual": {{"light": 0}}}}, {}}}}})",
            node);
    }
    return patch + "]";
}

constexpr std::string_view point = R"({"type": "point"})";
constexpr std::string_view sun = R"({"type": "directional"})";
constexpr std::string_view spot =
    R"({"type": "spot", "spot": {"outerConeAngle": 0.4636476}})";  // its tangent is 1/2
constexpr std::string_view behind = R"("translation": [0, 0, -2])";

/// The quad with colours: three vertices white, the last one as given, in bytes.
std::string colored(std::string_view color, std::string_view mode,
                    std::string_view surface = R"({"metallicFactor": 0})") {
    std::string bytes(12, '\xff');
    for (const auto& part : nlohmann::json::parse(color))
        bytes += static_cast<char>(std::lround(255 * part.get<double>()));
    std::string uri = "data:;base64," + base64(bytes);
    return fmt::format(
        R"([{{"op": "add", "path": "/buffers/-", "value": {{"byteLength": 16, "uri": "{}"}}}},
            {{"op": "add", "path": "/bufferViews/-", "value": {{"buffer": 1, "byteLength": 16}}}},
            {{"op": "add", "path": "/accessors/-", "value": {{"bufferView": 3, "componentType": 5121, "count": 4,
              "type": "VEC4", "normalized": true}}}},
            {{"op": "add", "path": "/meshes/0/primitives/0/attributes/COLOR_0", "value": 4}},
            {{"op": "add", "path": "/materials/0/alphaMode", "value": "{}"}},
            {{"op": "add", "path": "/materials/0/pbrMetallicRoughness", "value": {}}}])",
        uri, mode, surface);
}

/// A picture of two pixels, in alpha 64 and 255, and one that is opaque, as PNG.
std::string png(unsigned char alpha) {
    std::vector<unsigned char> file;
    lodepng::encode(file, std::vector<unsigned char>{9, 9, 9, alpha, 9, 9, 9, 255}, 2, 1);
    return "data:image/png;base64," + base64(std::string(file.begin(), file.end()));
}

/// A masked material whose base colour is that texture times that factor.
std::string masked(std::string_view texture, std::string_view factor) {
    return fmt::format(
        R"([{{"op": "add", "path": "/images", "value": [{{"uri": "{}"}}, {{"uri": "{}"}}]}},
            {{"op": "add", "path": "/textures", "value": [{{"source": 0}}, {{"source": 1}}]}},
            {{"op": "add", "path": "/materials/0/alphaMode", "value": "MASK"}},
            {{"op": "add", "path": "/materials/0/pbrMetallicRoughness",
              "value": {{"baseColorTexture": {}, "baseColorFactor": {}}}}}])",
        png(64), png(255), texture, factor);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, Effects,
    testing::Values(
        Judged{"point_near", "[]", "point 0", "in, at 2 up to 0.25 arrives"},
        Judged{"point_touching", put("/nodes/1/translation", "[0, 0, 0]"), "point 0",
               "in, it may be as near as can be"},
        Judged{"point_dark", light(R"({"type": "point", "intensity": 0})"), "point 0",
               "out, its intensity is 0"},
        Judged{"point_black", light(R"({"type": "point", "color": [0, 0, 0]})"), "point 0",
               "out, its intensity is 0"},
        Judged{"point_out_of_range", light(R"({"type": "point", "range": 1.5})"), "point 0",
               "out, bounds begin 0.5 beyond its range of 1.5"},
        Judged{"point_just_in_range", light(R"({"type": "point", "range": 2})"), "point 0",
               "in, at 2 up to 0.25 arrives"},
        Judged{"point_faded", light(point, R"("translation": [0, 0, 50])"), "point 0",
               "out, at 50 it has fallen to 0.0004, below 0.0017"},
        Judged{"point_that_never_fades",
               light(R"({"type": "point", "extras": {"gobo": {"attenuation": [1, 0, 0]}}})",
                     R"("translation": [0, 0, 50])"),
               "point 0", "in, at 50 up to 1 arrives"},
        Judged{"point_behind", light(point, behind), "point 0", "out, every normal faces away from it"},
        Judged{"point_behind_two_sides",
               R"([{"op": "add", "path": "/materials/0/doubleSided", "value": true},
                   {"op": "replace", "path": "/nodes/1/translation", "value": [0, 0, -2]}])",
               "point 0", "in, at 2 up to 0.25 arrives"},
        Judged{"point_behind_a_turning_quad",
               R"([{"op": "replace", "path": "/nodes/1/translation", "value": [0, 0, -2]},
                   {"op": "add", "path": "/accessors/3/type", "value": "VEC4"},
                   {"op": "add", "path": "/accessors/3/byteOffset", "value": 0},
                   {"op": "add", "path": "/animations/-", "value": {"samplers": [{"input": 2, "output": 3}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}}])",
               "point 0", "in, at 0.586 up to 2.9 arrives"},
        Judged{
            "point_on_dark_material",
            put("/materials/0/extras", R"({"gobo": {"model": {"diffuse": [0,0,0], "specular": [0,0,0]}}})"),
            "point 0", "out, its material gives back no light"},
        Judged{"point_on_unlit_material", put("/materials/0/extensions", R"({"KHR_materials_unlit": {}})"),
               "point 0", "out, its material gives back no light"},
        Judged{"sun_in_front", light(sun), "directional 0", "in, it reaches everything"},
        Judged{"sun_behind", light(sun, R"("rotation": [0, 1, 0, 0])"), "directional 0",
               "out, every normal faces away from it"},
        Judged{"sun_too_weak", light(R"({"type": "directional", "intensity": 0.001})"), "directional 0",
               "out, its radiance is 0.001, below 0.0017"},
        Judged{"spot_on_it", light(spot), "spot 0", "in, at 2 up to 0.25 arrives"},
        Judged{"spot_turned_away", light(spot, R"("translation": [0, 0, 2], "rotation": [0, 1, 0, 0])"),
               "spot 0", "out, cone misses bounds by 2"},
        // The edge of the cone passes (1, 0, 0) at 3 cos - 2 sin of the half angle: 4 / sqrt 5.
        Judged{"spot_beside", light(spot, R"("translation": [4, 0, 2])"), "spot 0",
               "out, cone misses bounds by 1.8"},
        Judged{"spot_beside_but_wide",
               light(R"({"type": "spot", "spot": {"outerConeAngle": 1.2}})", R"("translation": [4, 0, 2])"),
               "spot 0", "in, at 3.61 up to 0.077 arrives"},
        Judged{"spot_without_cone", light(R"({"type": "spot", "spot": {"outerConeAngle": 0}})"), "spot 0",
               "out, its cone is empty"},
        Judged{
            "spot_turning",
            R"([{"op": "replace", "path": "/extensions/KHR_lights_punctual/lights/0", "value": {"type": "spot"}},
                   {"op": "add", "path": "/nodes/1/rotation", "value": [0, 1, 0, 0]},
                   {"op": "add", "path": "/accessors/3/type", "value": "VEC4"},
                   {"op": "add", "path": "/accessors/3/byteOffset", "value": 0},
                   {"op": "add", "path": "/animations/-", "value": {"samplers": [{"input": 2, "output": 3}],
                    "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]}}])",
            "spot 0", "in, at 2 up to 0.25 arrives"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Material, Effects,
    testing::Values(
        Judged{"specular", "[]", "specular", "in, blinn, shininess 30"},
        Judged{"specular_phong", put("/nodes/0/extras", R"({"gobo": {"specular": "phong"}})"), "specular",
               "in, phong, shininess 30"},
        Judged{"specular_unwanted", put("/scenes/0/extras", R"({"gobo": {"specular": "none"}})"), "specular",
               "out, not asked for"},
        Judged{"specular_of_rough_material", put("/materials/0/pbrMetallicRoughness/roughnessFactor", "1"),
               "specular", "out, its material has no highlight"},
        Judged{"specular_in_the_dark", light(point, behind), "specular", "out, no light is in"},
        Judged{"specular_under_toon", put("/materials/0/extras", R"({"gobo": {"toon": 3}})"), "specular",
               "out, toon shading has no highlights"},
        Judged{"toon", put("/materials/0/extras", R"({"gobo": {"toon": 3}})"), "toon", "in, 3 levels"},
        Judged{"toon_unwanted", "[]", "toon", "out, not asked for"},
        Judged{"toon_of_the_scene_taken_back",
               R"([{"op": "add", "path": "/scenes/0/extras", "value": {"gobo": {"toon": 3}}},
                   {"op": "add", "path": "/nodes/0/extras", "value": {"gobo": {"toon": 0}}}])",
               "toon", "out, not asked for"},
        Judged{"two_sided", put("/materials/0/doubleSided", "true"), "sides",
               "in, its material is marked doubleSided"},
        Judged{"one_sided", "[]", "sides", "out, not marked"},
        Judged{"cutout_by_vertices", colored("[1, 1, 1, 0.25]", "MASK"), "cutout",
               "in, its alpha falls to 0.251, below 0.5"},
        Judged{"cutout_by_a_picture_unknown", masked(R"({"index": 0, "texCoord": 1})", "[1, 1, 1, 1]"),
               "cutout", "in, its alpha falls to 0, below 0.5"},
        Judged{"cutout_by_a_picture", masked(R"({"index": 0})", "[1, 1, 1, 0.9]"), "cutout",
               "in, its alpha falls to 0.226, below 0.5"},
        Judged{"mask_of_an_opaque_picture", masked(R"({"index": 1})", "[1, 1, 1, 1]"), "cutout",
               "out, its alpha is nowhere below 0.5"},
        Judged{"mask_that_cuts_nothing", put("/materials/0/alphaMode", R"("MASK")"), "cutout",
               "out, its alpha is nowhere below 0.5"},
        Judged{"blend_is_no_cutout", put("/materials/0/alphaMode", R"("BLEND")"), "cutout",
               "out, alphaMode is not MASK"},
        Judged{"colored", colored("[1, 0.5, 1, 1]", "OPAQUE"), "vertex_color",
               "in, its vertices have colours"},
        Judged{"colored_white", colored("[1, 1, 1, 1]", "OPAQUE"), "vertex_color", "out, all are white"},
        Judged{"alpha_of_an_opaque_one", colored("[1, 1, 1, 0.25]", "OPAQUE"), "vertex_color",
               "out, all are white"},
        Judged{"alpha_of_a_mask", colored("[1, 1, 1, 0.25]", "MASK"), "vertex_color",
               "in, its vertices are not opaque"},
        Judged{"colored_metal",
               colored("[1, 0.5, 1, 1]", "OPAQUE", R"({"metallicFactor": 1, "roughnessFactor": 0.5})"),
               "vertex_color", "out, its material has no diffuse or ambient colour"},
        Judged{"not_colored", "[]", "vertex_color", "out, it has none"},
        Judged{"textured",
               R"([{"op": "add", "path": "/textures", "value": [{}]},
                   {"op": "add", "path": "/materials/0/normalTexture", "value": {"index": 0}}])",
               "texture", "in, its material has textures"}),
    [](const auto& row) { return row.param.name; });

/// The scene's word about the light around.
std::string around(std::string_view gobo, std::string_view material = "{}") {
    return fmt::format(
        R"([{{"op": "add", "path": "/scenes/0/extras", "value": {{"gobo": {}}}}},
            {{"op": "add", "path": "/materials/0/extras", "value": {{"gobo": {}}}}}])",
        gobo, material);
}

constexpr std::string_view black = R"({"model": {"diffuse": [0, 0, 0], "specular": [0, 0, 0]}})";

INSTANTIATE_TEST_SUITE_P(
    LightAround, Effects,
    testing::Values(
        Judged{"hemisphere", around(R"({"probe": {"kind": "hemisphere", "sky": [1, 1, 1]}})"), "probe",
               "in, hemisphere"},
        Judged{"harmonics",
               around(R"({"probe": {"kind": "spherical_harmonics", "coefficients": [[1, 1, 1], [0, 0, 0],
                         [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]}})"),
               "probe", "in, spherical_harmonics"},
        Judged{"no_probe", "[]", "probe", "out, not asked for"},
        Judged{"probe_taken_back",
               around(R"({"probe": {"kind": "image"}})", R"({"probe": {"kind": "none"}})"), "probe",
               "out, not asked for"},
        Judged{"probe_on_black", around(R"({"probe": {"kind": "image"}})", black), "probe",
               "out, its material gives back no ambient light"},
        Judged{"reflection", around(R"({"reflection": 0.5})"), "reflection", "in, a share of 0.5"},
        Judged{"no_reflection", around(R"({"reflection": 0})"), "reflection", "out, not asked for"},
        Judged{"reflection_on_black", around(R"({"reflection": 0.5})", black), "reflection",
               "out, its material has no highlight"},
        Judged{"quality", around(R"({"quality": {"shading": "vertex"}})"), "shading", "in, asked for"},
        Judged{"no_quality", "[]", "shading", "no such effect"}),
    [](const auto& row) { return row.param.name; });

std::string fog(std::string_view members) {
    return put("/scenes/0/extras", fmt::format(R"({{"gobo": {{"fog": {{{}}}}}}})", members));
}

// The eye is at (0, 0, 5): the quad's corners are sqrt 27 = 5.2 away.
INSTANTIATE_TEST_SUITE_P(
    Fog, Effects,
    testing::Values(
        Judged{"none", "[]", "fog", "out, none is stated"},
        Judged{"linear_reached", fog(R"("kind": "linear", "near": 5, "far": 9)"), "fog",
               "in, bounds end at 5.2, it begins at 5"},
        Judged{"linear_not_reached", fog(R"("kind": "linear", "near": 5.3, "far": 9)"), "fog",
               "out, bounds end at 5.2, it begins at 5.3"},
        Judged{"exponential_thick", fog(R"("kind": "exponential", "density": 0.1)"), "fog",
               "in, at 5.2 it hides 0.41"},
        Judged{"exponential_thin", fog(R"("kind": "exponential", "density": 0.0001)"), "fog",
               "out, at 5.2 it hides 0.00052, below 0.002"},
        Judged{"squared_thin", fog(R"("kind": "exponential_squared", "density": 0.001)"), "fog",
               "out, at 5.2 it hides 2.7e-05, below 0.002"},
        Judged{"node_without_fog",
               R"([{"op": "add", "path": "/scenes/0/extras", "value": {"gobo": {"fog": {"kind": "linear"}}}},
                   {"op": "add", "path": "/nodes/0/extras", "value": {"gobo": {"fog": {"kind": "none"}}}}])",
               "fog", "out, none is stated"},
        Judged{"no_camera",
               R"([{"op": "add", "path": "/scenes/0/extras",
                    "value": {"gobo": {"fog": {"kind": "linear", "near": 100, "far": 200}}}},
                   {"op": "remove", "path": "/nodes/2/camera"}])",
               "fog", "in, no camera tells the distance"}),
    [](const auto& row) { return row.param.name; });

/// Another quad, moved to a place, and a lamp that casts shadows.
std::string with_caster(std::string_view place, std::string_view lamp = R"({"type": "point"})") {
    return fmt::format(
        R"([{{"op": "replace", "path": "/extensions/KHR_lights_punctual/lights/0", "value": {}}},
            {{"op": "add", "path": "/extensions/KHR_lights_punctual/lights/0/extras",
              "value": {{"gobo": {{"shadow": true}}}}}},
            {{"op": "add", "path": "/nodes/-", "value": {{"name": "screen", "mesh": 0, "translation": {}}}}},
            {{"op": "add", "path": "/scenes/0/nodes/-", "value": 3}}])",
        lamp, place);
}

INSTANTIATE_TEST_SUITE_P(
    Shadow, Effects,
    testing::Values(Judged{"no_caster_light", "[]", "shadow", "out, no light casts any"},
                    Judged{"caster_between", with_caster("[0, 0, 1]"), "shadow of point 0",
                           "in, 'screen' may shade it"},
                    Judged{"caster_elsewhere", with_caster("[5, 0, 1]"), "shadow of point 0",
                           "out, nothing can shade it"},
                    Judged{"caster_beside_the_sun", with_caster("[2.5, 0, 1]", R"({"type": "directional"})"),
                           "shadow of directional 0", "out, nothing can shade it"},
                    Judged{"caster_before_the_sun", with_caster("[1.5, 0, 1]", R"({"type": "directional"})"),
                           "shadow of directional 0", "in, 'screen' may shade it"},
                    Judged{"caster_behind", with_caster("[0, 0, -1]", R"({"type": "directional"})"),
                           "shadow of directional 0", "out, nothing can shade it"}),
    [](const auto& row) { return row.param.name; });

TEST(SceneEffects, SharedMeshesAreJudgedForEachNode) {
    const Scene scene = read_patched(
        R"([{"op": "add", "path": "/nodes/-", "value": {"name": "far quad", "mesh": 0, "translation": [0, 0, -90]}},
            {"op": "add", "path": "/scenes/0/nodes/-", "value": 3}])");
    const std::vector<Draw> draws = required_effects(scene, {}, {});
    ASSERT_EQ(draws.size(), 2U);
    EXPECT_TRUE(draws[0].effects[0].is_in);
    EXPECT_FALSE(draws[1].effects[0].is_in);
    EXPECT_EQ(draws[1].name, "far quad");
}

/// Volumes and boxes at random: where a gap is proven, no point of the box is nearer to the volume; where no
/// point of the box is, the gap is found, up to the sampling's coarseness.
TEST(SceneLitVolume, ProvenGapsAreTrueAndTight) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-4, 4);
    std::uniform_real_distribution<double> share(0, 1);
    const auto place = [&] { return glm::dvec3(anywhere(random), anywhere(random), anywhere(random)); };
    int apart = 0;
    for (int i = 0; i < 300; ++i) {
        const LitVolume volume{place(), glm::normalize(place()), 1.5 * share(random),
                               0.5 + 5 * share(random)};
        Box box;
        box.add(place());
        box.add(place());
        const double gap = proven_gap(volume, box);
        double nearest = std::numeric_limits<double>::infinity();
        constexpr int cells = 12;
        for (int k = 0; k < cells * cells * cells; ++k) {
            const glm::dvec3 along(k % cells, k / cells % cells, k / cells / cells);
            const glm::dvec3 at = box.low + (box.high - box.low) * along / double(cells - 1);
            nearest = std::min(nearest, glm::distance(at, volume.nearest_to(at)));
        }
        const double cell = glm::length(box.high - box.low) / (cells - 1);
        EXPECT_LE(gap, nearest + 1e-12)
            << "volume " << i;  // rounding of a few operations on numbers below 10
        EXPECT_GE(gap, nearest - cell - 1e-3) << "volume " << i;  // 64 steps leave less than that
        apart += gap > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 50) << "too few are apart to show anything";
    EXPECT_LT(apart, 250);
}

}  // namespace
}  // namespace gobo::scene
