// The hard cases of `lit`: at inputs where the textbook's formulas fail, every permutation that they concern
// gives what the case demands, with no undefined operation on the way. And each guard that this takes is
// needed: without it, the case it is there for fails.
#include "lit_cases.hpp"

#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/file_system.hpp"

namespace gobo {
namespace {

class LitCase : public testing::TestWithParam<Case> {};

TEST_P(LitCase, GivesWhatIsDemanded) {
    EXPECT_THAT(faults_of(GetParam()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(HardCases, LitCase, testing::ValuesIn(lit_cases()),
                         [](const auto& tested) { return tested.param.name; });

/// A guard, and the plain formula that stands there without it.
struct Guard {
    std::string name;
    std::string piece;
    std::string guarded;
    std::string plain;
    std::string needed_by;  ///< name of a case
};

const std::vector<Guard> kGuards = {
    {"attenuation_reach", "lighting/attenuation.glsl", "min(d, 1e17)", "d", "H_L3_beyond_all_bounds"},
    {"attenuation_denominator", "lighting/attenuation.glsl", "max(denominator, 1e-18)", "denominator",
     "H_L2_no_attenuation"},
    {"light_from_behind", "lighting/response.glsl", "if (cosine > 0.0)", "if (true)",
     "H_S4_light_from_behind"},
    {"interpolated_radiance", "shading/vertex.frag.glsl", "max(interpolatedRadiance(), vec3(0.0))",
     "interpolatedRadiance()", "H_I1_interpolated_below_zero"},
    {"depth_greater_side", "depth/greater.glsl", "depthOffset.offset > 0.0 ? depthOffset.offset : 0.0",
     "depthOffset.offset", "H_D1_H_D2_depth_offsets"},
    {"depth_greater_range", "depth/greater.glsl", "min(gl_FragCoord.z + away, 1.0)", "gl_FragCoord.z + away",
     "H_D1_H_D2_depth_offsets"},
    {"depth_less_side", "depth/less.glsl", "depthOffset.offset < 0.0 ? depthOffset.offset : 0.0",
     "depthOffset.offset", "H_D1_H_D2_depth_offsets"},
    {"depth_less_range", "depth/less.glsl", "max(gl_FragCoord.z + closer, 0.0)", "gl_FragCoord.z + closer",
     "H_D1_H_D2_depth_offsets"},
    {"depth_any_above", "depth/any.glsl", "min(moved, 1.0)", "moved", "H_D1_H_D2_depth_offsets"},
    {"depth_any_below", "depth/any.glsl", "moved > 0.0 ? min(moved, 1.0) : 0.0", "min(moved, 1.0)",
     "H_D1_H_D2_depth_offsets"},
    {"cone_hard_edge", "spot/cone.glsl", "if (versine <= innerVersine) return 1.0;", "",
     "H_P1_hard_edge_inside"},
    {"cone_everything", "spot/cone.glsl", "min(versineBetween(axis, ray), 1.9999998)",
     "versineBetween(axis, ray)", "H_P2_cone_of_180_degrees"},
    {"cone_tiny_angle", "angle/versine.glsl",
     "cosine > 0.5 ? 0.5 * dot(difference, difference) : 1.0 - cosine", "1.0 - cosine",
     "H_P4_tiny_cone_outside"},
    {"power_series", "power/exact.glsl", "if (versine > 0.1875) return", "return", "H_S3_sharp_highlights"},
    {"power_negative_base", "power/exact.glsl", "if (versine < 1.0)", "if (true)", "H_S2_negative_base"},
    {"power_zero_exponent", "power/exact.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0", "H_S1_shininess_zero"},
    {"toon_top_band", "diffuse/toon.glsl", "min(floor(levels * cosine), levels - 1.0)",
     "floor(levels * cosine)", "H_T1_cosine_of_one"},
    {"shadow_beside", "shadow/visibility.glsl", "isBeside || w == 0.0", "w == 0.0", "H_W1_behind_the_light"},
    {"shadow_zero", "shadow/visibility.glsl", "isBeside || w == 0.0", "isBeside", "H_W1_behind_the_light"},
    {"fog_step", "fog/linear.glsl", "if (depth == 0.0)", "if (false)", "H_F1_step_beyond"},
    {"fog_square", "fog/exponential_squared.glsl", "min(fog.density * fogDistance(), 16.0)",
     "fog.density * fogDistance()", "H_F2_very_far"},
    {"fog_hides_all", "fog/blend.glsl", "clearness > 0.0 ? mix(fog.color, radiance, clearness) : fog.color",
     "mix(fog.color, radiance, clearness)", "H_F3_infinite_radiance_in_the_fog"},
    {"length_scale", "guards/vector_length.glsl", "= vectorScale(v)", "= 1.0", "H_F2_very_far"},
    {"polar_scale", "guards/polar.glsl", "= vectorScale(v)", "= 1.0", "H_N2_light_very_near"},
    {"polar_zero", "guards/polar.glsl", "max(square, 1e-30)", "square", "H_L1_light_at_the_surface"},
    {"scale_zero", "guards/full.glsl", "max(largest, 1e-37)", "largest", "H_N1_zero_normal"},
    {"direction_scale", "guards/unit_vector.glsl", "v / vectorScale(v)", "v", "H_N3_long_normal"},
    {"toon_ceil_top_band", "diffuse/toon_ceil.glsl", "min(ceil(levels * cosine), levels)",
     "ceil(levels * cosine)", "H_T1_cosine_of_one_at_full_tone"},
    {"irradiance_not_negative", "ambient/spherical_harmonics.glsl",
     "max(harmonics.scale * irradiance(), vec3(0.0))", "harmonics.scale * irradiance()",
     "H_B1_one_bright_small_light"},
    {"sky_share", "hemisphere/cosine.glsl", "clamp(0.5 + 0.5 * dot(normal, up), 0.0, 1.0)",
     "0.5 + 0.5 * dot(normal, up)", "H_I1_normal_longer_than_one_under_a_sky"},
    {"side_of_a_mirrored_model", "surface/side.frag.glsl", "gl_FrontFacing != (handedness > 0.0)",
     "!gl_FrontFacing", "H_G2_front_of_a_mirrored_model"},
    {"handedness", "surface/handedness.vert.glsl",
     "determinant(mat3(transform.modelView)) < 0.0 ? -1.0 : 1.0", "1.0", "H_G2_back_of_a_mirrored_model"},
    {"material_row", "sides/material/one.glsl", "clamp(index, 0, rows - 1)", "index",
     "S10_index_behind_the_table"},
    {"material_pair", "sides/material/two_materials.glsl", "clamp(index, 0, rows / 2 - 1)", "index",
     "S10_index_behind_the_pairs"},
    {"interpolated_color", "surface/color.frag.glsl", "max(vertexColor, vec4(0.0))", "vertexColor",
     "H_I1_color_below_zero"},
    {"homogeneous_w", "homogeneous/homogeneous.glsl", "abs(w) >= 1e-6", "w != 0.0", "L6_hardly_any_w"},
    {"direction_zero", "guards/unit_vector.glsl", "max(dot(scaled, scaled), 1e-30)", "dot(scaled, scaled)",
     "H_N1_zero_normal"},
};

const Case* case_named(const std::string& name) {
    for (const Case& tested : lit_cases())
        if (tested.name == name) return &tested;
    return nullptr;
}

void PrintTo(const Guard& guard, std::ostream* out) {
    *out << guard.name;
}

class LitGuard : public testing::TestWithParam<Guard> {};

TEST_P(LitGuard, IsNeeded) {
    const Guard& guard = GetParam();
    const std::string path = "shader_lib/" + guard.piece;
    const Result<std::string> text = DiskFileSystem().read(std::string(GOBO_SOURCE_DIR) + "/" + path);
    ASSERT_TRUE(text);
    const auto at = text->find(guard.guarded);
    ASSERT_NE(at, std::string::npos) << path << " has no '" << guard.guarded << "'";
    std::string plain = *text;
    plain.replace(at, guard.guarded.size(), guard.plain);
    const Case* tested = case_named(guard.needed_by);
    ASSERT_NE(tested, nullptr) << guard.needed_by;
    EXPECT_THAT(faults_of(*tested, {{guard.piece, plain}}, 1), testing::Not(testing::IsEmpty()));
}

INSTANTIATE_TEST_SUITE_P(HardCases, LitGuard, testing::ValuesIn(kGuards),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gobo
