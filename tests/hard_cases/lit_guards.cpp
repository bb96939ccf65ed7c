#include "lit_guards.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "core/text.hpp"
#include "pbr_guards.hpp"

namespace gobo {
namespace {

// One row for each guard; a line may hold several. Removing it (taking `plain` for `guarded`) must make the
// case fail that is named last.
const std::vector<Guard> kGuards = {
    {"attenuation_reach", "lighting/attenuation.glsl", "min(d, 1e17)", "d", "beyond_all_bounds"},
    {"attenuation_denominator", "lighting/attenuation.glsl", "max(denominator, 1e-18)", "denominator",
     "no_attenuation"},
    {"light_from_behind", "lighting/response.glsl", "if (cosine > 0.0)", "if (true)", "light_from_behind"},
    {"interpolated_radiance", "shading/vertex.frag.glsl", "max(interpolatedRadiance(), vec3(0.0))",
     "interpolatedRadiance()", "interpolated_below_zero"},
    {"depth_greater_side", "depth/greater.glsl", "depthOffset.offset > 0.0 ? depthOffset.offset : 0.0",
     "depthOffset.offset", "depth_offsets"},
    {"depth_greater_range", "depth/greater.glsl", "min(gl_FragCoord.z + away, 1.0)", "gl_FragCoord.z + away",
     "depth_offsets"},
    {"depth_less_side", "depth/less.glsl", "depthOffset.offset < 0.0 ? depthOffset.offset : 0.0",
     "depthOffset.offset", "depth_offsets"},
    {"depth_less_range", "depth/less.glsl", "max(gl_FragCoord.z + closer, 0.0)", "gl_FragCoord.z + closer",
     "depth_offsets"},
    {"depth_any_above", "depth/any.glsl", "min(moved, 1.0)", "moved", "depth_offsets"},
    {"depth_any_below", "depth/any.glsl", "moved > 0.0 ? min(moved, 1.0) : 0.0", "min(moved, 1.0)",
     "depth_offsets"},
    {"cone_hard_edge", "spot/cone.glsl", "if (oneMinusCosine <= innerOneMinusCosine) return 1.0;", "",
     "hard_edge_inside"},
    {"cone_everything", "spot/cone.glsl", "min(coneOneMinusCosine(axis, ray), 1.9999998)",
     "coneOneMinusCosine(axis, ray)", "cone_of_180_degrees"},
    {"cone_tiny_angle", "angle/one_minus_cosine.glsl",
     "cosine > 0.5 ? 0.5 * dot(difference, difference) : 1.0 - cosine", "1.0 - cosine", "tiny_cone_outside"},
    {"halfway_opposed", "angle/halfway.glsl", "max(dot(halfway, halfway), 1e-30)", "dot(halfway, halfway)",
     "light_behind_the_viewers_ray"},
    {"halfway_small_angle", "angle/halfway.glsl", "if (cosine < 0.8) return", "return", "sharp_highlights"},
    {"power_series", "power/exact.glsl",
     "-2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0))))",
     "log(1.0 - oneMinusCosine)", "sharp_highlights"},
    {"power_negative_base", "power/exact.glsl", "if (oneMinusCosine < 1.0)", "if (true)", "negative_base"},
    {"power_zero_exponent", "power/exact.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0", "shininess_zero"},
    {"toon_top_band", "diffuse/toon.glsl", "min(floor(levels * cosine), levels - 1.0)",
     "floor(levels * cosine)", "cosine_of_one"},
    {"image_of_no_direction", "ambient/image.glsl", "if (direction == vec3(0.0))", "if (false)",
     "no_normal_to_look_up"},
    {"mirror_of_no_direction", "reflection/image.glsl", "if (!isKnown)", "if (false)", "nothing_to_mirror"},
    {"shadow_beside", "shadow/visibility.glsl", "isBeside || w == 0.0", "w == 0.0", "behind_the_light"},
    {"shadow_zero", "shadow/visibility.glsl", "isBeside || w == 0.0", "isBeside", "behind_the_light"},
    {"fog_step", "fog/linear.glsl", "if (depth == 0.0)", "if (false)", "step_beyond"},
    {"fog_square", "fog/exponential_squared.glsl", "min(fog.density * fogDistance(), 16.0)",
     "fog.density * fogDistance()", "very_far"},
    {"fog_hides_all", "fog/blend.glsl", "fogFactor > 1e-30 ? mix(fog.color, radiance, fogFactor) : fog.color",
     "mix(fog.color, radiance, fogFactor)", "infinite_radiance_in_the_fog"},
    {"length_scale", "guards/vector_length.glsl", "= vectorScale(v)", "= 1.0", "very_far"},
    {"polar_scale", "guards/polar.glsl", "= vectorScale(v)", "= 1.0", "light_very_near"},
    {"polar_zero", "guards/polar.glsl", "max(square, 1e-30)", "square", "light_at_the_surface"},
    {"scale_zero", "guards/full.glsl", "max(largest, 1e-37)", "largest", "zero_normal"},
    {"direction_scale", "guards/unit_vector.glsl", "v / vectorScale(v)", "v", "long_normal"},
    {"toon_ceil_top_band", "diffuse/toon_ceil.glsl", "min(ceil(levels * cosine), levels)",
     "ceil(levels * cosine)", "cosine_of_one_at_full_tone"},
    {"irradiance_not_negative", "ambient/spherical_harmonics.glsl",
     "max(harmonics.scale * irradiance(), vec3(0.0))", "harmonics.scale * irradiance()",
     "one_bright_small_light"},
    {"sky_weight", "hemisphere/cosine.glsl", "clamp(0.5 + 0.5 * dot(normal, up), 0.0, 1.0)",
     "0.5 + 0.5 * dot(normal, up)", "normal_longer_than_one_under_a_sky"},
    {"sky_weight_by_sine", "hemisphere/sine.glsl",
     "clamp(0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine), 0.0, 1.0)",
     "0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine)",
     "normal_longer_than_one_away_from_a_sky"},
    {"sine_of_the_sky", "hemisphere/sine.glsl", "sqrt(dot(across, across))", "length(across)",
     "normal_nearly_along_a_sky"},
    {"side_of_a_mirrored_model", "surface/side.frag.glsl", "gl_FrontFacing != (handedness > 0.0)",
     "!gl_FrontFacing", "front_of_a_mirrored_model"},
    {"handedness", "surface/handedness.vert.glsl",
     "determinant(mat3(transform.modelView)) < 0.0 ? -1.0 : 1.0", "1.0", "back_of_a_mirrored_model"},
    {"material_row", "sides/material/one.glsl", "clamp(index, 0, rows - 1)", "index",
     "index_behind_the_table"},
    {"material_pair", "sides/material/two_materials.glsl", "clamp(index, 0, rows / 2 - 1)", "index",
     "index_behind_the_pairs"},
    {"interpolated_color", "surface/color.frag.glsl", "max(vertexColor, vec4(0.0))", "vertexColor",
     "color_below_zero"},
    {"directional_or_point_w", "directional_or_point/either_ray.glsl", "abs(w) >= 9.5367431640625e-7",
     "w != 0.0", "hardly_any_w"},
    {"direction_zero", "guards/unit_vector.glsl", "max(dot(scaled, scaled), 1e-30)", "dot(scaled, scaled)",
     "zero_normal"},
    {"interpolated_share", "shading/interpolated_ray.frag.glsl", "max(ray.w, 0.0)", "ray.w",
     "interpolated_share_below_zero"},
    {"interpolated_one_minus_cosine", "normal/one_minus_cosine/interpolated.glsl",
     "max(1.0 - dot(a, b), 0.0)", "1.0 - dot(a, b)", "normal_longer_than_one_as_it_is"},
    {"cosine_edge_nothing", "spot_edge/cosine.glsl", "max(1.0 - dot(axis, ray), 0.0)", "1.0 - dot(axis, ray)",
     "cone_of_0_degrees_by_cosine"},
    {"angle_edge_zero", "spot_edge/angle.glsl", "if (sine + abs(cosine) == 0.0) return 1.0;", "",
     "light_at_the_surface_by_angle"},
    {"near_exact_negative_base", "power/highlight/near_exact.glsl", "oneMinusCosine >= 1.0",
     "oneMinusCosine >= 2.0", "negative_base_near_exact"},
    {"near_exact_zero_exponent", "power/highlight/near_exact.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0",
     "shininess_zero_without_logarithm"},
    {"schlick_negative_base", "power/highlight/schlick.glsl", "oneMinusCosine >= 1.0",
     "oneMinusCosine >= 2.0", "negative_base_squaring"},
    {"schlick_zero_exponent", "power/highlight/schlick.glsl", "exponent > 0.0 ? 0.0 : 1.0", "0.0",
     "shininess_zero_without_logarithm"},
    {"squaring_negative_base", "power/highlight/squaring.glsl", "max(1.0 - oneMinusCosine, 0.0)",
     "1.0 - oneMinusCosine", "negative_base_squaring"},
    {"lyon_negative_base", "power/highlight/lyon.glsl", "max(1.0 - 0.25 * exponent * oneMinusCosine, 0.0)",
     "1.0 - 0.25 * exponent * oneMinusCosine", "negative_base_lyon"},
    {"ordinary_direction_zero", "guards/unit_vector/ordinary.glsl", "max(dot(v, v), 1e-30)", "dot(v, v)",
     "zero_normal_ordinary"},
    {"ordinary_polar_zero", "guards/polar/ordinary.glsl", "max(square, 1e-30)", "square",
     "light_at_the_surface_ordinary"},
    {"half_float_largest", "output_range/half_float.glsl", "min(radiance, vec3(65504.0))", "radiance",
     "half_float"},
    {"display_brightest", "output_range/display.glsl", "min(radiance, vec3(1.0))", "radiance", "display"},
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
    for (const std::vector<Case>* cases : {&lit_cases(), &pbr_cases()})
        for (const Case& tested : *cases)
            if (tested.name == name) return &tested;
    return nullptr;
}

}  // namespace gobo
