#include "lit_guards.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

// One row for each guard; a line may hold several. Removing it (taking `plain` for `guarded`) must make the
// case fail that is named last.
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
    {"cone_hard_edge", "spot/cone.glsl", "if (oneMinusCosine <= innerOneMinusCosine) return 1.0;", "",
     "H_P1_hard_edge_inside"},
    {"cone_everything", "spot/cone.glsl", "min(coneOneMinusCosine(axis, ray), 1.9999998)",
     "coneOneMinusCosine(axis, ray)", "H_P2_cone_of_180_degrees"},
    {"cone_tiny_angle", "angle/one_minus_cosine.glsl",
     "cosine > 0.5 ? 0.5 * dot(difference, difference) : 1.0 - cosine", "1.0 - cosine",
     "H_P4_tiny_cone_outside"},
    {"halfway_opposed", "angle/halfway.glsl", "max(dot(halfway, halfway), 1e-30)", "dot(halfway, halfway)",
     "H_N4_light_behind_the_viewers_ray"},
    {"halfway_small_angle", "angle/halfway.glsl", "if (cosine < 0.8) return", "return",
     "H_S3_sharp_highlights"},
    {"power_series", "power/exact.glsl",
     "-2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0))))",
     "log(1.0 - oneMinusCosine)", "H_S3_sharp_highlights"},
    {"power_negative_base", "power/exact.glsl", "if (oneMinusCosine < 1.0)", "if (true)",
     "H_S2_negative_base"},
    {"power_zero_exponent", "power/exact.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0", "H_S1_shininess_zero"},
    {"toon_top_band", "diffuse/toon.glsl", "min(floor(levels * cosine), levels - 1.0)",
     "floor(levels * cosine)", "H_T1_cosine_of_one"},
    {"image_of_no_direction", "ambient/image.glsl", "if (direction == vec3(0.0))", "if (false)",
     "H_N1_no_normal_to_look_up"},
    {"mirror_of_no_direction", "reflection/image.glsl", "if (!isKnown)", "if (false)",
     "H_N1_nothing_to_mirror"},
    {"shadow_beside", "shadow/visibility.glsl", "isBeside || w == 0.0", "w == 0.0", "H_W1_behind_the_light"},
    {"shadow_zero", "shadow/visibility.glsl", "isBeside || w == 0.0", "isBeside", "H_W1_behind_the_light"},
    {"fog_step", "fog/linear.glsl", "if (depth == 0.0)", "if (false)", "H_F1_step_beyond"},
    {"fog_square", "fog/exponential_squared.glsl", "min(fog.density * fogDistance(), 16.0)",
     "fog.density * fogDistance()", "H_F2_very_far"},
    {"fog_hides_all", "fog/blend.glsl", "fogFactor > 1e-30 ? mix(fog.color, radiance, fogFactor) : fog.color",
     "mix(fog.color, radiance, fogFactor)", "H_F3_infinite_radiance_in_the_fog"},
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
    {"sky_weight", "hemisphere/cosine.glsl", "clamp(0.5 + 0.5 * dot(normal, up), 0.0, 1.0)",
     "0.5 + 0.5 * dot(normal, up)", "H_I1_normal_longer_than_one_under_a_sky"},
    {"sky_weight_by_sine", "hemisphere/sine.glsl",
     "clamp(0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine), 0.0, 1.0)",
     "0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine)",
     "H_I1_normal_longer_than_one_away_from_a_sky"},
    {"sine_of_the_sky", "hemisphere/sine.glsl", "sqrt(dot(across, across))", "length(across)",
     "H_N2_normal_nearly_along_a_sky"},
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
    {"directional_or_point_w", "directional_or_point/either_ray.glsl", "abs(w) >= 9.5367431640625e-7",
     "w != 0.0", "L6_hardly_any_w"},
    {"direction_zero", "guards/unit_vector.glsl", "max(dot(scaled, scaled), 1e-30)", "dot(scaled, scaled)",
     "H_N1_zero_normal"},
    {"interpolated_share", "shading/interpolated_ray.frag.glsl", "max(ray.w, 0.0)", "ray.w",
     "H_I1_interpolated_share_below_zero"},
    {"interpolated_one_minus_cosine", "normal/one_minus_cosine/interpolated.glsl",
     "max(1.0 - dot(a, b), 0.0)", "1.0 - dot(a, b)", "H_I1_normal_longer_than_one_as_it_is"},
    {"cosine_edge_nothing", "spot_edge/cosine.glsl", "max(1.0 - dot(axis, ray), 0.0)", "1.0 - dot(axis, ray)",
     "H_P2_cone_of_0_degrees_by_cosine"},
    {"angle_edge_zero", "spot_edge/angle.glsl", "if (sine + abs(cosine) == 0.0) return 1.0;", "",
     "H_L1_light_at_the_surface_by_angle"},
    {"near_exact_negative_base", "power/highlight/near_exact.glsl", "oneMinusCosine >= 1.0",
     "oneMinusCosine >= 2.0", "H_S2_negative_base_near_exact"},
    {"near_exact_zero_exponent", "power/highlight/near_exact.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0",
     "H_S1_shininess_zero_without_logarithm"},
    {"schlick_negative_base", "power/highlight/schlick.glsl", "oneMinusCosine >= 1.0",
     "oneMinusCosine >= 2.0", "H_S2_negative_base_squaring"},
    {"schlick_zero_exponent", "power/highlight/schlick.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0",
     "H_S1_shininess_zero_without_logarithm"},
    {"squaring_negative_base", "power/highlight/squaring.glsl", "max(1.0 - oneMinusCosine, 0.0)",
     "1.0 - oneMinusCosine", "H_S2_negative_base_squaring"},
    {"lyon_negative_base", "power/highlight/lyon.glsl", "max(1.0 - 0.25 * exponent * oneMinusCosine, 0.0)",
     "1.0 - 0.25 * exponent * oneMinusCosine", "H_S2_negative_base_lyon"},
    {"ordinary_direction_zero", "guards/unit_vector/ordinary.glsl", "max(dot(v, v), 1e-30)", "dot(v, v)",
     "H_N1_zero_normal_ordinary"},
    {"ordinary_polar_zero", "guards/polar/ordinary.glsl", "max(square, 1e-30)", "square",
     "H_L1_light_at_the_surface_ordinary"},
    {"half_float_largest", "output_range/half_float.glsl", "min(radiance, vec3(65504.0))", "radiance",
     "H_X1_half_float"},
    {"display_brightest", "output_range/display.glsl", "min(radiance, vec3(1.0))", "radiance",
     "H_X1_display"},
};

/// Code, and behind it a comment that says what it guards against.
bool is_mark(std::string_view line) {
    const auto comment = line.find("// guard: ");
    return comment != std::string_view::npos && !trim(line.substr(0, comment)).empty();
}

}  // namespace

const std::vector<Guard>& lit_guards() {
    return kGuards;
}

std::vector<GuardMark> guard_marks() {
    std::vector<GuardMark> marks;
    for (const std::string& piece : piece_paths()) {
        const std::string text = piece_text(piece);
        const auto lines = std::count(text.begin(), text.end(), '\n');
        for (int line = 1; line <= lines; ++line)
            if (is_mark(line_of(text, line)))
                marks.push_back({piece, line, std::string(line_of(text, line)),
                                 std::string(line > 1 ? line_of(text, line - 1) : "")});
    }
    std::sort(marks.begin(), marks.end(), [](const GuardMark& a, const GuardMark& b) {
        return std::tie(a.piece, a.line) < std::tie(b.piece, b.line);
    });
    return marks;
}

std::string without_guard(const Guard& guard) {
    std::string text = piece_text(guard.piece);
    const auto at = text.find(guard.guarded);
    EXPECT_NE(at, std::string::npos) << "shader_lib/" << guard.piece << " has no '" << guard.guarded << "'";
    return at == std::string::npos ? text : text.replace(at, guard.guarded.size(), guard.plain);
}

const Case* case_named(const std::string& name) {
    const auto& cases = lit_cases();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const Case& tested) { return tested.name == name; });
    return found == cases.end() ? nullptr : &*found;
}

}  // namespace gobo
