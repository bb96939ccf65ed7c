#include "pbr_guards.hpp"

namespace gobo {
namespace {

const Inputs kBlack = {{"Material.emission", {0, 0, 0}},
                       {"Material.baseColor", {0, 0, 0, 1}},
                       {"Material.metallic", {0}},
                       {"Material.dielectric", {0, 0, 0}}};
const Inputs kMirror = {
    {"Material.emission", {0, 0, 0}}, {"Material.baseColor", {1, 1, 1, 1}}, {"Material.metallic", {1}}};
/// The viewer is at the back, the light exactly behind its ray.
const Inputs kLightBehindTheRay = {{"position", {0, 0, 5}}};
/// The half vector lies in the surface: the viewer is as far below it as the light is above.
const Inputs kHalfVectorInTheSurface = {{"position", {3, 0, 4}},
                                        {"DirectionalLights.lights[].direction", {0, 0.6, 0.8}}};
const Inputs kWhiteSheen = {{"Material.emission", {0, 0, 0}}, {"Material.baseColor", {1, 1, 1, 1}},
                            {"Material.metallic", {0}},       {"Material.sheenColor", {1, 1, 1}},
                            {"Material.sheenRoughness", {0}}, {"Ambient.color", {0, 0, 0}}};
/// Viewer and light look along the surface.
const Inputs kAlongTheSurface = {{"position", {3, 0, 0}},
                                 {"DirectionalLights.lights[].direction", {0, 1, 1.2e-38}}};
const Inputs kLongNormal = {{"eyeNormal", {0, 0, 1.000001}}};
/// Nothing to mirror: no normal, or the viewer at the surface.
const Inputs kNoNormal = {{"normal", {0, 0, 0}}};
const Inputs kViewerAtTheSurface = {{"position", {0, 0, 0}}};

Inputs table(double a, double b) {
    return {{"environmentBrdfTable", {a, b, 0, 1}}};
}

/// Of keys of one directional light that hold what `where` says of these features.
Case lit_by_one(std::string name, const std::string& where, std::vector<Inputs> points, Check check,
                std::vector<std::string> features) {
    features.insert(features.begin(), "directional");
    return {std::move(name),     {},   "directional == 1 && " + where, std::move(points), std::move(check),
            std::move(features), "pbr"};
}

/// Of keys without a light, in an environment.
Case mirroring(std::string name, const std::string& where, std::vector<Inputs> points, Check check,
               std::vector<std::string> features) {
    features.insert(features.begin(), "reflection");
    return {std::move(name),     {},   "reflection == image && " + where, std::move(points), std::move(check),
            std::move(features), "pbr"};
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        lit_by_one("roughness_0", "clearcoat == none && anisotropy == none", {{{"Material.roughness", {0}}}},
                   robust(), {"clearcoat", "distribution", "visibility", "diffuse_lobe"}),
        lit_by_one("coat_of_roughness_0", "clearcoat == layer", {{{"Material.clearcoatRoughness", {0}}}},
                   robust(), {"clearcoat", "distribution", "visibility"}),
        lit_by_one("light_from_behind_a_surface", "clearcoat == none",
                   {{{"DirectionalLights.lights[].direction", {0.6, 0, -0.8}}}},
                   same_as({{"DirectionalLights.lights[].color", {0, 0, 0}}}),
                   {"clearcoat", "visibility", "diffuse_lobe"}),
        lit_by_one("light_behind_the_ray", "clearcoat == none", {kLightBehindTheRay}, robust(),
                   {"clearcoat", "distribution", "visibility", "anisotropy"}),
        lit_by_one("half_vector_in_the_surface", "visibility == correlated", {kHalfVectorInTheSurface},
                   robust(), {"visibility"}),
        lit_by_one("brushed_without_tangents", "anisotropy == brushed",
                   {with(kHalfVectorInTheSurface, {{"tangent", {0, 0, 0, 1}}})}, robust(), {"anisotropy"}),
        lit_by_one("vertices_brighter_than_white", "vertex_color == modulate && fresnel == constant",
                   {with(kLightBehindTheRay, {{"Material.emission", {0, 0, 0}},
                                              {"Material.baseColor", {1, 1, 1, 1}},
                                              {"Material.dielectric", {1, 1, 1}},
                                              {"vertexColor", {1.000001, 1.000001, 1.000001, 1}},
                                              {"Ambient.color", {0, 0, 0}}})},
                   robust(), {"vertex_color", "fresnel"}),
        lit_by_one("peak_of_a_long_normal",
                   "distribution == plain && normal == interpolated && visibility == correlated",
                   {with(kLongNormal, {{"Material.roughness", {0}}})},
                   same_as({{"eyeNormal", {0, 0, 1}}}, 0.25), {"distribution", "normal", "visibility"}),
        lit_by_one("dielectric_of_f0_1", "fresnel == exact",
                   {{{"Material.dielectric", {1, 1, 1}}, {"Material.metallic", {0}}}}, robust(), {"fresnel"}),
        lit_by_one("dielectric_of_f0_0_edge_on", "fresnel == exact",
                   {with(kLightBehindTheRay, {{"Material.dielectric", {0, 0, 0}}})}, robust(), {"fresnel"}),
        lit_by_one("dielectric_that_reflects_nothing", "fresnel == exact",
                   {{{"Material.dielectric", {0, 0, 0}}, {"Material.dielectricEdge", {0}}}}, robust(),
                   {"fresnel"}),
        lit_by_one("black_under_a_long_direction", "fresnel == schlick",
                   {with(kBlack, {{"DirectionalLights.lights[].direction", {0, 0, 1.000001}},
                                  {"Ambient.color", {0, 0, 0}}})},
                   robust(), {"fresnel"}),
        lit_by_one("light_nearly_behind_the_ray", "visibility == half_angle",
                   {with(kMirror, {{"position", {3, 0, 4}},
                                   {"Material.roughness", {1}},
                                   {"Ambient.color", {0, 0, 0}},
                                   {"DirectionalLights.lights[].direction", {0.60001, 0, 0.8}}})},
                   near_double(1e-4), {"visibility"}),
        lit_by_one("table_of_zeros", "multiple_scattering == returned && environment_brdf == table",
                   {table(0, 0)}, robust(), {"multiple_scattering", "environment_brdf"}),
        lit_by_one("texel_without_a_direction", "normal_map == tangent",
                   {{{"normalMap", {0.5, 0.5, 0.5, 1}}}}, same_as({{"normalMap", {0.5, 0.5, 1, 1}}}, 1e-5),
                   {"normal_map"}),
        mirroring("mirrored_by_white_without_a_lobe",
                  "multiple_scattering == returned && environment_brdf == table",
                  {with(kMirror, table(0, 0))}, robust(), {"multiple_scattering", "environment_brdf"}),
        lit_by_one("coat_edge_on", "clearcoat == layer && visibility == correlated",
                   {kHalfVectorInTheSurface}, robust(), {"clearcoat", "visibility"}),
        lit_by_one("coat_lit_from_behind", "clearcoat == layer",
                   {{{"DirectionalLights.lights[].direction", {0.6, 0, -0.8}}}},
                   same_as({{"DirectionalLights.lights[].color", {0, 0, 0}}}), {"clearcoat", "visibility"}),
        lit_by_one("coat_behind_the_ray", "clearcoat == layer", {kLightBehindTheRay}, robust(),
                   {"clearcoat", "distribution", "visibility"}),
        lit_by_one("sheen_of_roughness_0", "sheen == charlie", {kWhiteSheen}, robust(), {"sheen"}),
        lit_by_one("beneath_a_white_sheen", "sheen == charlie && clearcoat == none",
                   {with(kWhiteSheen, kLightBehindTheRay)}, robust(), {"sheen", "diffuse_lobe"}),
        lit_by_one("sheen_of_a_long_normal", "sheen == charlie && normal == interpolated", {kLongNormal},
                   robust(), {"sheen", "normal"}),
        lit_by_one("sheen_along_the_surface", "sheen == charlie && clearcoat == none",
                   {with(kWhiteSheen, kAlongTheSurface)}, robust(), {"sheen"}),
        lit_by_one("film_over_a_mirror_edge_on", "iridescence == thin_film",
                   {with(kMirror, kLightBehindTheRay)}, robust(), {"iridescence"}),
        lit_by_one("film_of_air_under_a_long_direction", "iridescence == thin_film",
                   {{{"Iridescence.ior", {1}}, {"DirectionalLights.lights[].direction", {0, 0, 1.000001}}}},
                   robust(), {"iridescence"}),
        lit_by_one("film_of_half_a_wave_over_black", "iridescence == thin_film",
                   {with(kBlack, {{"Iridescence.ior", {2}},
                                  {"Iridescence.thickness", {305}},
                                  {"Ambient.color", {0, 0, 0}}})},
                   robust(), {"iridescence"}),
        lit_by_one("film_over_what_is_brighter_than_white",
                   "iridescence == thin_film && vertex_color == modulate && fresnel == constant",
                   {with(kLightBehindTheRay, {{"Material.emission", {0, 0, 0}},
                                              {"Iridescence.factor", {0}},
                                              {"Material.baseColor", {1, 1, 1, 1}},
                                              {"Material.dielectric", {1, 1, 1}},
                                              {"vertexColor", {1.000001, 1.000001, 1.000001, 1}},
                                              {"Ambient.color", {0, 0, 0}}})},
                   robust(), {"iridescence", "vertex_color", "fresnel"}),
        lit_by_one("picture_that_does_not_change", "normal_map == derivatives", {Inputs{}}, robust(),
                   {"normal_map"}),
        lit_by_one("step_without_a_direction", "normal_map == derivatives",
                   {{{"normalMap", {0.5, 0.5, 0.5, 1}}}}, same_as({{"normalMap", {0.5, 0.5, 1, 1}}}, 1e-5),
                   {"normal_map"}),
        Case{"light_beyond_its_range",
             {},
             "point == 1 && light_range == windowed",
             {{{"PointLights.lights[].position", {0, 0, 5, 1}},
               {"Material.emission", {0, 0, 0}},
               {"Ambient.color", {0, 0, 0}}}},
             robust(),
             {"point", "light_range"},
             "pbr"},
        Case{"spot_beyond_its_range",
             {},
             "spot == 1 && light_range == windowed",
             {{{"SpotLights.lights[].position", {0, 0, 5, 1}},
               {"Material.emission", {0, 0, 0}},
               {"Ambient.color", {0, 0, 0}}}},
             robust(),
             {"spot", "light_range"},
             "pbr"},
        mirroring("rough_black_mirror_by_lazarov", "environment_brdf == lazarov",
                  {with(kBlack, {{"Material.roughness", {1}}, {"Ambient.color", {0, 0, 0}}})}, robust(),
                  {"environment_brdf"}),
        // As a table of 8 bits may round them.
        mirroring("more_than_all_mirrored", "multiple_scattering == returned && environment_brdf == table",
                  {with(with(kMirror, table(0.8, 0.2005)), {{"specularMap", {0, 0, 0, 1}}})}, robust(),
                  {"multiple_scattering", "environment_brdf"}),
        mirroring("rough_black_mirror", "environment_brdf == karis",
                  {with(kBlack, {{"Material.roughness", {1}}, {"Ambient.color", {0, 0, 0}}})}, robust(),
                  {"environment_brdf"}),
        mirroring("mirrored_without_a_direction", "clearcoat == none", {kNoNormal, kViewerAtTheSurface},
                  same_as({{"Reflection.weight", {0}}}), {"clearcoat"}),
        mirroring("coat_without_a_direction", "clearcoat == layer", {kNoNormal, kViewerAtTheSurface},
                  same_as({{"Reflection.weight", {0}}}), {"clearcoat"}),
    };
    return all;
}

const std::vector<Guard> kGuards = {
    {"alpha", "pbr/surface.glsl", "max(surface.roughness * surface.roughness, 0.002)",
     "surface.roughness * surface.roughness", "roughness_0"},
    {"facing_the_viewer", "pbr/surface.glsl", "max(dot(surface.normal, surface.toViewer), 1e-4)",
     "dot(surface.normal, surface.toViewer)", "half_vector_in_the_surface"},
    {"coat_alpha", "clearcoat/layer.glsl",
     "max(material.clearcoatRoughness * material.clearcoatRoughness, 0.002)",
     "material.clearcoatRoughness * material.clearcoatRoughness", "coat_of_roughness_0"},
    {"coat_facing_the_viewer", "clearcoat/layer.glsl", "max(dot(coatNormal, surface.toViewer), 1e-4)",
     "dot(coatNormal, surface.toViewer)", "coat_edge_on"},
    {"coat_from_behind", "clearcoat/layer.glsl", "if (nl > 0.0 && square >= 1e-12)", "if (square >= 1e-12)",
     "coat_lit_from_behind"},
    {"coat_without_half_vector", "clearcoat/layer.glsl", "if (nl > 0.0 && square >= 1e-12)", "if (nl > 0.0)",
     "coat_behind_the_ray"},
    {"sheen_alpha", "sheen/charlie.glsl", "max(material.sheenRoughness * material.sheenRoughness, 0.07)",
     "material.sheenRoughness * material.sheenRoughness", "sheen_of_roughness_0"},
    {"sheen_albedo", "sheen/charlie.glsl", "min(exp(dot(byCosine, vec4(1.0, r, r * r, r * r * r))), 1.0)",
     "exp(dot(byCosine, vec4(1.0, r, r * r, r * r * r)))", "beneath_a_white_sheen"},
    {"sheen_head_on", "sheen/charlie.glsl", "min(surface.nv, 1.0)", "surface.nv", "sheen_of_a_long_normal"},
    {"sheen_edge_on", "sheen/charlie.glsl", "clamp(nl, 1e-4, 1.0)", "min(nl, 1.0)",
     "sheen_along_the_surface"},
    {"steps_of_nothing", "normal_map/shaded/derivatives.glsl", "inversesqrt(max(longer, 1e-30))",
     "inversesqrt(longer)", "picture_that_does_not_change"},
    {"texel_of_no_step", "normal_map/shaded/derivatives.glsl",
     "dot(mapped, mapped) < 1e-12 ? normal : unitVector(mapped)", "unitVector(mapped)",
     "step_without_a_direction"},
    {"beyond_the_range", "light_range/window.glsl", "min(d * nearness, 1.0)", "d * nearness",
     "light_beyond_its_range"},
    {"lazarov_range", "environment_brdf/lazarov.glsl", "max(b, 0.0)", "b", "rough_black_mirror_by_lazarov"},
    {"brushed_spread", "anisotropy/brushed.glsl", "max(dot(scaled, scaled), 0.05)", "dot(scaled, scaled)",
     "brushed_without_tangents"},
    {"scattered_by_smooth", "diffuse_lobe/oren_nayar.glsl", "max(1.0 - average, 1e-7)", "1.0 - average",
     "roughness_0"},
    {"plain_distribution", "distribution/plain.glsl", "max(1.0 - nh * nh, 0.0)", "1.0 - nh * nh",
     "peak_of_a_long_normal"},
    {"karis_range", "environment_brdf/karis.glsl", "clamp(vec2(-1.04, 1.04) * a + r.zw, 0.0, 1.0)",
     "vec2(-1.04, 1.04) * a + r.zw", "rough_black_mirror"},
    {"exact_index", "fresnel/exact.glsl", "min(sqrt(f0), 0.999)", "sqrt(f0)", "dielectric_of_f0_1"},
    {"exact_edge_on", "fresnel/exact.glsl", "max(eta * eta - 1.0 + c * c, 1e-12)", "eta * eta - 1.0 + c * c",
     "dielectric_of_f0_0_edge_on"},
    {"exact_of_nothing", "fresnel/exact.glsl",
     "edge > 0.0 ? min(material.dielectric / edge, vec3(1.0)) : vec3(0.0)",
     "min(material.dielectric / edge, vec3(1.0))", "dielectric_that_reflects_nothing"},
    {"schlick_head_on", "fresnel/schlick.glsl", "max(1.0 - vh, 0.0)", "1.0 - vh",
     "black_under_a_long_direction"},
    {"scattered_not_negative", "pbr/interface.glsl", "max(1.0 - mirrored, 0.0)", "1.0 - mirrored",
     "vertices_brighter_than_white"},
    {"film_between_mirrors", "iridescence/reflected/thin_film.glsl", "clamp(r12 * r23, 0.0, 0.9999)",
     "max(r12 * r23, 0.0)", "film_over_a_mirror_edge_on"},
    {"film_of_no_reflection", "iridescence/reflected/thin_film.glsl", "clamp(r12 * r23, 0.0, 0.9999)",
     "min(r12 * r23, vec3(0.9999))", "film_of_air_under_a_long_direction"},
    {"film_range", "iridescence/reflected/thin_film.glsl",
     "clamp(r12 + returned + 2.0 * (once + twice), 0.0, 1.0)", "r12 + returned + 2.0 * (once + twice)",
     "film_of_half_a_wave_over_black"},
    {"entering_not_negative", "iridescence/reflected/thin_film.glsl",
     "max(1.0 - max(mirrored.r, max(mirrored.g, mirrored.b)), 0.0)",
     "1.0 - max(mirrored.r, max(mirrored.g, mirrored.b))", "film_over_what_is_brighter_than_white"},
    {"no_half_vector", "lighting/response/metallic_roughness.glsl",
     "if (square < 1e-12) return underCoat(underSheen(diffuse, nl));", "", "light_behind_the_ray"},
    {"metallic_roughness_from_behind", "lighting/response/metallic_roughness.glsl", "if (nl > 0.0)",
     "if (true)", "light_from_behind_a_surface"},
    {"returned_not_negative", "multiple_scattering/returned.glsl", "max(1.0 - brdf.x - brdf.y, 0.0)",
     "1.0 - brdf.x - brdf.y", "more_than_all_mirrored"},
    {"returned_of_nothing", "multiple_scattering/returned.glsl", "max(1.0 - mean * lost, 1e-3)",
     "(1.0 - mean * lost)", "mirrored_by_white_without_a_lobe"},
    {"scale_of_nothing", "multiple_scattering/returned.glsl", "clamp(brdf.x + brdf.y, 0.1, 1.0)",
     "brdf.x + brdf.y", "table_of_zeros"},
    {"texel_of_no_direction", "normal_map/shaded/tangent.glsl",
     "dot(mapped, mapped) < 1e-12 ? normal : unitVector(mapped)", "unitVector(mapped)",
     "texel_without_a_direction"},
    {"mirror_of_no_normal", "reflection/mirrored/image.glsl", "if (normal == vec3(0.0))", "if (false)",
     "mirrored_without_a_direction"},
    {"environment_of_no_direction", "reflection/mirrored/image.glsl", "if (direction == vec3(0.0))",
     "if (false)", "coat_without_a_direction"},
    {"scattered_of_no_direction", "reflection/split_sum/image.glsl",
     "if (mirroredDirection(surface.normal) == vec3(0.0))", "if (false)", "mirrored_without_a_direction"},
    {"half_angle", "visibility/half_angle.glsl", "max(square, 1e-4)", "square",
     "light_nearly_behind_the_ray"},
};

}  // namespace

const std::vector<Case>& pbr_cases() {
    return cases();
}

const std::vector<Guard>& pbr_guards() {
    return kGuards;
}

std::vector<Guard> all_guards() {
    std::vector<Guard> guards = lit_guards();
    guards.insert(guards.end(), kGuards.begin(), kGuards.end());
    return guards;
}

}  // namespace gobo
