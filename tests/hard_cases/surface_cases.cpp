// The hard cases of the surface's own models.
#include <cmath>

#include "lit_cases.hpp"

namespace gobo {
namespace {

const Inputs kOnlyLights = {{"Material.emission", {0, 0, 0}}, {"Ambient.color", {0, 0, 0}}};
const Inputs kBlackBack = {{"Materials.rows[1].diffuse", {0, 0, 0}},
                           {"Materials.rows[1].ambient", {0, 0, 0}}};
const Inputs kMirrored = {{"Transform.modelView", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                          {"Transform.normalMatrix", {-1, 0, 0, 0, 1, 0, 0, 0, 1}}};
const Inputs kUnmirrored = {{"Transform.modelView", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                            {"Transform.normalMatrix", {1, 0, 0, 0, 1, 0, 0, 0, 1}}};

Inputs faces_front(bool is_front) {
    return {{"gl_FrontFacing", {is_front ? 1.0 : 0.0}}};
}

Inputs light_from(double x, double y, double z) {
    return {{"DirectionalLights.lights[].direction", {x, y, z}}};
}

Inputs either_light(double x, double y, double z, double w) {
    return {{"DirectionalOrPointLights.lights[].position", {x, y, z, w}},
            {"DirectionalOrPointLights.lights[].attenuation", {0, 0, 1}}};
}

Inputs index(double material) {
    return {{"materialIndex", {material}}};
}

/// A table whose ends are told apart from what lies between.
Inputs table(const Inputs& changes) {
    return with({{"Materials.rows[0].diffuse", {0.25, 0.25, 0.25}},
                 {"Materials.rows[12].diffuse", {0.5, 0.5, 0.5}},
                 {"Materials.rows[13].diffuse", {0.75, 0.75, 0.75}}},
                changes);
}

Inputs opacity(double alpha, double threshold) {
    return {{"opacityMap", {alpha}}, {"Cutout.threshold", {threshold}}};
}

/// Lights at the cosines and a rounding to either side.
std::vector<Inputs> beside(const std::vector<double>& cosines) {
    std::vector<Inputs> points;
    for (const double edge : cosines)
        for (const int ulps : {-1, 0, 1}) {
            const double cosine = edge + ulps * 0x1p-24;
            points.push_back(
                with(kOnlyLights, light_from(std::sqrt(std::max(1 - cosine * cosine, 0.0)), 0, cosine)));
        }
    return points;
}

std::vector<Case> toon_cases() {
    const std::vector<std::string> features = {"directional", "diffuse", "n_dot_l", "shading"};
    return {
        {"cosine_of_one_at_full_tone",
         {"tone above the top one"},
         "directional > 0 && (diffuse == toon_ceil || diffuse == toon_thresholds)",
         {with(kOnlyLights, light_from(0, 0, 1)), with(kOnlyLights, light_from(0, 0, 1.0000001))},
         is_color({1, 1, 1, 1}),
         features},
        {"beside_a_band_edge_of_ceil",
         {"edge between two tones"},
         "directional > 0 && diffuse == toon_ceil",
         beside({0.25, 0.5, 0.75}),
         is_neighbouring_band_of_ceil(),
         features},
        {"beside_a_threshold",
         {"edge between two tones"},
         "directional > 0 && diffuse == toon_thresholds",
         beside({0.25, 0.5, 0.95}),
         is_neighbouring_tone(),
         features},
        {"interpolated_cosine_beyond_one",
         {"tone above the top one"},
         "directional > 0 && n_dot_l == vertex && diffuse != toon",
         {with(kOnlyLights, {{"lightCosines[]", {1.000001, 0, 0, 0}}})},
         is_color({1, 1, 1, 1}),
         features},
        {"tones_of_the_vertices_cosines",
         {"toon, by thresholds"},
         "directional > 0 && n_dot_l == vertex && diffuse == toon_thresholds",
         {with(kOnlyLights, {{"lightCosines[]", {0.6, 0, 0, 0}}})},
         is_color({0.625, 0.625, 0.625, 1}),
         features},
        {"vertices_cosines_seen_from_the_back",
         {"toon, by thresholds"},
         "directional > 0 && n_dot_l == vertex && diffuse == toon_thresholds && sides == two",
         {with(with(kOnlyLights, faces_front(false)), {{"lightCosines[]", {0.6, 0, 0, 0}}}),
          with(with(kOnlyLights, faces_front(true)), {{"lightCosines[]", {-0.6, 0, 0, 0}}})},
         is_color({0, 0, 0, 1}),
         {"directional", "diffuse", "n_dot_l", "shading", "sides"}},
        {"thresholds_of_zero",
         {"edge between two tones"},
         "directional > 0 && diffuse == toon_thresholds",
         {with(with(kOnlyLights, light_from(1, 0, 1e-6)), {{"ToonThresholds.thresholds", {0, 0, 0}}})},
         is_color({1, 1, 1, 1}),
         features},
        {"no_tone_at_all",
         {"edge between two tones"},
         "directional > 0 && diffuse == toon_thresholds",
         {with(kOnlyLights, {{"ToonThresholds.tones", {0, 0, 0}}})},
         is_color({0, 0, 0, 1}),
         features},
    };
}

std::vector<Case> side_cases() {
    const std::vector<std::string> features = {"directional", "sides",    "material",
                                               "shading",     "specular", "ambient"};
    return {
        {"front_of_a_mirrored_model",
         {"mirrored model"},
         "sides != one",
         {with(with(with(kMirrored, faces_front(false)), kBlackBack), light_from(0.6, 0, 0.8))},
         same_as(with(kUnmirrored, faces_front(true))),
         features},
        {"back_of_a_mirrored_model",
         {"mirrored model"},
         "sides != one",
         {with(with(with(kMirrored, faces_front(true)), kBlackBack), light_from(0.6, 0, -0.8))},
         same_as(with(kUnmirrored, faces_front(false))),
         features},
        {"back_under_a_light_from_behind",
         {"mirrored model"},
         "sides == two && directional > 0 && ambient == global",
         {with(faces_front(false), light_from(0.6, 0, -0.8)),
          with(with(faces_front(false), light_from(0.6, 0, -0.8)), {{"position", {0, 0, 5}}})},
         same_as(with(faces_front(true), {{"normal", {0, 0, -1}}})),
         features},
        {"back_with_a_material_of_its_own",
         {"mirrored model"},
         "sides == two_materials && ambient == global && specular == none",
         {with(faces_front(false), kBlackBack)},
         is_color({0, 0, 0, 1}),
         features},
        {"no_side_of_a_flattened_model",
         {"singular model matrix"},
         "sides != one",
         {{{"position", {1, 2, 3}},
           {"Transform.modelView", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, -5, 1}},
           {"Transform.normalMatrix", {0, 0, 0, 0, 0, 0, 0, 0, 1}}}},
         robust(),
         features},
    };
}

std::vector<Case> material_cases() {
    const std::vector<std::string> features = {"directional", "sides", "material", "shading", "lighting"};
    return {
        {"index_before_the_table",
         {"array of materials"},
         "material == array",
         {table(index(-1)), table(index(-2147483648))},
         same_as(index(0)),
         features},
        {"index_behind_the_table",
         {"array of materials"},
         "material == array && sides != two_materials",
         {table(index(14)), table(index(2147483520))},
         same_as(index(13)),
         features},
        {"index_behind_the_pairs",
         {"array of materials"},
         "sides == two_materials",
         {table(index(7)), table(index(2147483520)), table(with(index(7), faces_front(false)))},
         same_as(index(6)),
         features},
        {"last_row",
         {"array of materials"},
         "material == array && sides != two_materials && lighting == unlit",
         {table(index(13))},
         is_color({0.75, 0.75, 0.75, 1}),
         features},
        {"last_pair",
         {"array of materials"},
         "sides == two_materials && lighting == unlit",
         {table(with(index(6), faces_front(true)))},
         is_color({0.5, 0.5, 0.5, 1}),
         features},
    };
}

std::vector<Case> colour_cases() {
    const std::vector<std::string> features = {"cutout", "vertex_color", "directional", "shading", "fog"};
    return {
        {"alpha_at_the_threshold",
         {"cutout"},
         "cutout == threshold",
         {opacity(0.5, 0.5), opacity(0, 0), opacity(1, 1)},
         is_there(true),
         features},
        {"alpha_below_the_threshold",
         {"cutout"},
         "cutout == threshold",
         {opacity(0.5 - 0x1p-25, 0.5), opacity(0, 1e-30), opacity(1 - 0x1p-24, 1)},
         is_there(false),
         features},
        {"alpha_of_the_vertices_counts",
         {"colour of the vertices"},
         "cutout == threshold && vertex_color == modulate",
         {with(opacity(1, 0.5), {{"color", {1, 1, 1, 0.25}}})},
         is_there(false),
         features},
        {"color_below_zero",
         {"interpolated out of range"},
         "vertex_color == modulate",
         {{{"vertexColor", {-1e-7, -1e-7, -1e-7, -1e-7}}}},
         same_as({{"vertexColor", {0, 0, 0, 0}}}),
         features},
    };
}

std::vector<Case> light_cases() {
    const std::vector<std::string> features = {"directional_or_point", "diffuse", "specular", "shading",
                                               "light_ambient"};
    const Inputs dark = {{"DirectionalOrPointLights.lights[].color", {0, 0, 0}}};
    return {
        {"either_kind_at_the_surface",
         {"light at the surface"},
         "directional_or_point == 1 && light_ambient == none",
         {either_light(0, 0, -5, 1), either_light(0, 0, -10, 2), either_light(0, 0, 0, 0)},
         same_as(dark),
         features},
        {"hardly_any_w",
         {"lights by the w convention"},
         "directional_or_point == 1",
         {either_light(0, 0, 1, 1e-7), either_light(0, 0, 1, -1e-7), either_light(0, 0, 1e6, 1e-40)},
         same_as(either_light(0, 0, 1, 0)),
         features},
        {"position_times_w",
         {"lights by the w convention"},
         "directional_or_point == 1",
         {either_light(0, 0, -4, 4), either_light(0, 0, 4, -4)},
         same_as(either_light(0, 0, -1, 1)),
         features},
        {"ambient_without_a_normal",
         {"ambient light of each light"},
         "directional == 1 && light_ambient == each",
         {{{"normal", {0, 0, 0}}}, light_from(0, 0, 0)},
         is_color({0.5, 0.5, 0.5, 1}),
         {"directional", "light_ambient", "shading", "specular"}},
        {"ambient_outside_the_cone",
         {"ambient light of each light"},
         "spot == 1 && light_ambient == each",
         {{{"position", {9, 0, -5}}}},
         is_color({0.5, 0.5, 0.5, 1}),
         {"spot", "light_ambient", "shading", "specular"}},
    };
}

std::vector<Case> environment_cases() {
    const std::vector<std::string> features = {"ambient", "hemisphere", "harmonics", "sides", "shading"};
    return {
        {"no_normal_under_a_sky",
         {"zero vector"},
         "ambient == hemisphere",
         {{{"normal", {0, 0, 0}}}, {{"Hemisphere.up", {0, 0, 0}}}},
         is_color({0.5, 0.5, 0.5, 1}),
         features},
        {"normal_longer_than_one_under_a_sky",
         {"interpolated out of range"},
         "ambient == hemisphere && sides == one",
         {{{"Hemisphere.up", {0, 0, 1.000001}},
           {"Hemisphere.sky", {0, 0, 0}},
           {"Hemisphere.ground", {1, 1, 1}}}},
         is_color({0.125, 0.125, 0.125, 1}),
         features},
        {"normal_longer_than_one_away_from_a_sky",
         {"interpolated out of range"},
         "ambient == hemisphere && normal == interpolated && sides == one && shading == fragment",
         {{{"eyeNormal", {0, 0, 1.00001}},
           {"Hemisphere.up", {0, 0, -1}},
           {"Hemisphere.sky", {1, 1, 1}},
           {"Hemisphere.ground", {0, 0, 0}}}},
         is_color({0.125, 0.125, 0.125, 1}),
         {"ambient", "hemisphere", "normal", "sides", "shading"}},
        {"normal_nearly_along_a_sky",
         {"tiny vector"},
         "ambient == hemisphere && sides == one && shading == fragment",
         {{{"eyeNormal", {1e-20, 0, 1}},
           {"Hemisphere.up", {0, 0, 1}},
           {"Hemisphere.sky", {0, 0, 0}},
           {"Hemisphere.ground", {1, 1, 1}}}},
         is_color({0.125, 0.125, 0.125, 1}),
         {"ambient", "hemisphere", "normal", "sides", "shading"}},
        // Just above and just below the horizon the sky is half of what is seen, however short the normal.
        {"short_normal_at_the_horizon_of_a_sky",
         {"hemisphere of sky and ground"},
         "ambient == hemisphere && sides == one && shading == fragment",
         {{{"eyeNormal", {0.5, 0, 1e-7}}, {"Hemisphere.up", {0, 0, 1}}}},
         same_as({{"eyeNormal", {0.5, 0, -1e-7}}}, 1e-6),
         {"ambient", "hemisphere", "normal", "sides", "shading"}},
        {"negative_irradiance",
         {"ringing harmonics"},
         "ambient == spherical_harmonics",
         {{{"Harmonics.coefficients[]", {-1, -1, -1}}}},
         is_color({0.125, 0.125, 0.125, 1}),
         features},
        // A small light straight ahead, its coefficients the basis functions there; seen at 122 degrees from
        // it, where second order rings lowest.
        {"one_bright_small_light",
         {"ringing harmonics"},
         "ambient == spherical_harmonics && harmonics == second && sides == one",
         {{{"Harmonics.coefficients[0]", {0.282095e5, 0.282095e5, 0.282095e5}},
           {"Harmonics.coefficients[2]", {0.488603e5, 0.488603e5, 0.488603e5}},
           {"Harmonics.coefficients[6]", {0.630783e5, 0.630783e5, 0.630783e5}},
           {"normal", {0.8459, 0, -0.5333}}}},
         is_color({0.125, 0.125, 0.125, 1}),
         features},
    };
}

}  // namespace

std::vector<Case> surface_cases() {
    std::vector<Case> all;
    for (const auto& part :
         {toon_cases(), side_cases(), material_cases(), colour_cases(), light_cases(), environment_cases()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace gobo
