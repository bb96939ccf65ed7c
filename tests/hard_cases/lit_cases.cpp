#include "lit_cases.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace gobo {
namespace {

const Inputs kNoLight = {{"DirectionalLights.lights[].color", {0, 0, 0}},
                         {"PointLights.lights[].color", {0, 0, 0}},
                         {"SpotLights.lights[].color", {0, 0, 0}}};
const Inputs kNoHighlight = {{"Material.strength", {0}}};
/// All around, and as bright everywhere.
const Inputs kWideCone = {{"SpotLights.lights[].innerOneMinusCosine", {2}},
                          {"SpotLights.lights[].outerOneMinusCosine", {2}},
                          {"SpotLights.lights[].exponent", {0}}};
const Inputs kOnlyLights = {{"Material.emission", {0, 0, 0}}, {"Ambient.color", {0, 0, 0}}};
constexpr std::array<double, 4> kFogColor = {0.5, 0.25, 0.75, 1};

// Directions that are unit to 2e-7 (the shiniest ordinary material here has 8, a cosine's error counts
// shininess times, and a handful of roundings follows).
constexpr double kByDirection = 1e-5;

/// Features of the cases that quality values have of their own.
const std::vector<std::string> kQuality = {"directional", "point",  "spot",     "specular",
                                           "shading",     "guards", "spot_edge"};
const std::vector<std::string> kHighlightQuality = {"directional", "point", "spot",  "specular",
                                                    "shading",     "power", "viewer"};

Inputs cone(double one_minus_cosine) {
    return {{"SpotLights.lights[].innerOneMinusCosine", {one_minus_cosine}},
            {"SpotLights.lights[].outerOneMinusCosine", {one_minus_cosine}}};
}

/// A point on the plane z = -5 at an angle (radians) from the axis of the spot light.
Inputs off_axis(double angle) {
    return {{"position", {5 * std::tan(angle), 0, -5}}};
}

Inputs light_at(double x, double y, double z) {
    return {{"PointLights.lights[].position", {x, y, z, 1}}, {"SpotLights.lights[].position", {x, y, z, 1}}};
}

Inputs light_from(double x, double y, double z) {
    return {{"DirectionalLights.lights[].direction", {x, y, z}}};
}

Inputs fog_from_to(double near, double far) {
    return {{"Fog.start", {near}}, {"Fog.end", {far}}};
}

const std::vector<std::string> kShadowFeatures = {
    "directional",         "point",         "spot",         "shading",
    "directional_shadows", "point_shadows", "spot_shadows", "shadow_filter"};

/// The point as a shadow map has it, before the division; everything on the map is nearer to the light.
Inputs dark_map_at(double x, double y, double depth, double w) {
    return {{"shadowMaps", {0}},
            {"Shadows.shadows[].toMap", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, x, y, depth, w}}};
}

/// Light at a cosine k / 4 to the normal, moved by so many roundings.
Inputs band_edge(int k, int ulps) {
    const double cosine = k / 4.0 + ulps * 0x1p-24;
    return with(kOnlyLights, light_from(std::sqrt(1 - cosine * cosine), 0, cosine));
}

/// Beside the highlight's peak, by an angle that it still reaches.
std::vector<Inputs> sharp_highlights() {
    std::vector<Inputs> points;
    for (const double shininess : {1e4, 1e5, 1e6})
        for (const double widths : {0.0, 0.5, 1.0, 2.0}) {
            const double angle = widths / std::sqrt(shininess);
            points.push_back(with(with(kOnlyLights, light_from(std::sin(angle), 0, std::cos(angle))),
                                  {{"Material.shininess", {shininess}}, {"Material.diffuse", {0, 0, 0}}}));
        }
    return points;
}

/// Offsets to either side and far too large, on surfaces at either end of the range and within.
std::vector<Inputs> depths() {
    std::vector<Inputs> points;
    for (const double offset :
         {-1.5, -0.5, -1e-9, 0.0, 1e-9, 0.5, 1.5, std::numeric_limits<double>::quiet_NaN()})
        for (const double own : {0.0, 1e-7, 0.5, 0.9999999, 1.0})
            points.push_back({{"DepthOffset.offset", {offset}}, {"gl_FragCoord", {0.5, 0.5, own, 1}}});
    return points;
}

const std::vector<std::string> kWithRange = {"directional", "point",   "spot",
                                             "fog",         "shading", "output_range"};

/// Around the largest number that a 16-bit float holds, and from where on it rounds to infinity.
std::vector<Inputs> bright_surfaces() {
    std::vector<Inputs> points;
    for (const double emission : {0.5, 1.5, 65504.0, 65519.0, 65520.0, 1e5, 1e30})
        points.push_back({{"Material.emission", {emission, 0.25, 0}}, {"Fog.color", {emission, 1, 0}}});
    return points;
}

const double kTiny = 1e-4;  // radians
const double kTinyOneMinusCosine = 2 * std::sin(kTiny / 2) * std::sin(kTiny / 2);

const std::vector<Case> kCases = {
    {"zero_normal",
     {"zero vector"},
     "directional + point + spot > 0",
     {{{"normal", {0, 0, 0}}}},
     same_as(kNoLight)},
    {"normals_cancel",
     {"zero vector"},
     "directional + point + spot > 0 && shading == fragment",
     {{{"eyeNormal", {0, 0, 0}}}},
     same_as(kNoLight)},
    {"no_normal_to_look_up",
     {"zero vector"},
     "ambient == image",
     {{{"normal", {0, 0, 0}}}, {{"ImageLight.toMap", {0, 0, 0, 0, 0, 0, 0, 0, 0}}}},
     same_as({{"ImageLight.weight", {0}}}),
     {"ambient", "reflection", "shading"}},
    {"nothing_to_mirror",
     {"zero vector"},
     "reflection == image",
     {{{"normal", {0, 0, 0}}},
      {{"position", {0, 0, 0}}},
      {{"Reflection.toMap", {0, 0, 0, 0, 0, 0, 0, 0, 0}}}},
     same_as({{"Reflection.weight", {0}}}),
     {"ambient", "reflection", "shading"}},
    {"viewer_at_the_surface", {"zero vector"}, "", {{{"position", {0, 0, 0}}}}, near_double(kByDirection)},
    {"short_normal",
     {"tiny vector"},
     "directional + point + spot > 0",
     {{{"normal", {1e-20, 2e-20, 2e-20}}}, {{"normal", {1e-30, 2e-30, 2e-30}}}},
     same_as({{"normal", {1, 2, 2}}}, kByDirection)},
    {"light_very_near",
     {"tiny vector"},
     "point + spot > 0",
     {with({{"position", {0, 0, 0}}}, light_at(1e-20, 0, 2e-20)),
      with({{"position", {0, 0, 0}}}, light_at(1e-30, 0, 2e-30))},
     same_as(light_at(1, 0, 2), kByDirection)},
    {"long_normal",
     {"huge vector"},
     "directional + point + spot > 0",
     {{{"normal", {1e20, 2e20, 2e20}}}, {{"normal", {1e30, 2e30, 2e30}}}},
     same_as({{"normal", {1, 2, 2}}}, kByDirection)},
    {"light_very_far",
     {"huge vector"},
     "point + spot > 0",
     {with({{"position", {0, 0, 0}}}, light_at(1e20, 0, 2e20))},
     same_as(light_at(1, 0, 2), kByDirection)},
    {"light_behind_the_viewers_ray",
     {"light behind the viewer's ray"},
     "directional > 0 && specular != none",
     {with({{"normal", {0, 0, -1}}}, light_from(0, 0, -1))},
     same_as(kNoHighlight)},
    {"shininess_zero",
     {"zero to the power of zero"},
     "directional > 0 && specular != none && fog == none",
     {with({{"Material.shininess", {0}}, {"Material.diffuse", {0, 0, 0}}}, light_from(0, 0, 1)),
      with({{"Material.shininess", {0}}, {"Material.diffuse", {0, 0, 0}}}, light_from(1, 0, 1e-8)),
      with({{"Material.shininess", {0}}, {"Material.diffuse", {0, 0, 0}}, {"position", {-9, 0, 9}}},
           light_from(0.8, 0, 0.6))},
     // x^0 is 1 for every x: a quarter of ambient light and emission, and the whole highlight
     is_color({1.25, 1.25, 1.25, 1})},
    {"negative_base",
     {"power of a negative base"},
     "directional > 0 && specular != none",
     {with({{"position", {-9, 0, 9}}}, light_from(0.8, 0, 0.6)),
      with({{"position", {-9, 0, 9}}, {"Material.shininess", {0.5}}}, light_from(0.8, 0, 0.6))},
     same_as(kNoHighlight)},
    {"sharp_highlights",
     {"sharp highlight"},
     "directional > 0 && specular != none && fog == none",
     sharp_highlights(),
     is_sharp_to_rounding()},
    {"light_from_behind",
     {"light behind the surface"},
     "directional > 0",
     {light_from(0, 0, -1), light_from(1, 0, 0), light_from(0, 0, 0)},
     same_as(kNoLight)},
    {"light_at_the_surface",
     {"light at the surface"},
     "point + spot > 0",
     {light_at(0, 0, -5)},
     same_as(kNoLight)},
    {"no_attenuation",
     {"no attenuation"},
     "point + spot > 0",
     {{{"PointLights.lights[].attenuation", {0, 0, 0}}, {"SpotLights.lights[].attenuation", {0, 0, 0}}}},
     near_double(kByDirection)},
    {"beyond_all_bounds",
     {"huge numbers"},
     "directional + point + spot > 0",
     {{{"DirectionalLights.lights[].color", {1e30, 1e30, 1e30}},
       {"PointLights.lights[].color", {1e30, 1e30, 1e30}},
       {"SpotLights.lights[].color", {1e30, 1e30, 1e30}}},
      {{"Material.shininess", {1e6}}, {"SpotLights.lights[].exponent", {1e6}}},
      with(light_at(0, 0, 1e19), {{"PointLights.lights[].attenuation", {0, 0, 1e3}},
                                  {"SpotLights.lights[].attenuation", {0, 0, 1e3}}})},
     robust()},
    {"hard_edge_inside",
     {"hard-edged cone"},
     "spot > 0",
     {with(cone(0.25), off_axis(0.5))},
     same_as(kWideCone)},
    {"hard_edge_outside",
     {"hard-edged cone"},
     "spot > 0",
     {with(cone(0.25), off_axis(0.8))},
     same_as(kNoLight)},
    {"on_the_hard_edge",
     {"hard-edged cone"},
     "spot > 0",
     {with(cone(0.25), off_axis(std::acos(0.75)))},
     robust()},
    {"cone_of_0_degrees", {"limiting cone angle"}, "spot > 0", {cone(0)}, same_as(kNoLight)},
    {"cone_of_90_degrees_before",
     {"limiting cone angle"},
     "spot > 0",
     {with(cone(1), off_axis(1.5))},
     same_as(kWideCone)},
    {"cone_of_90_degrees_behind",
     {"limiting cone angle"},
     "spot > 0",
     {with(cone(1), {{"position", {0, 0, 5}}, {"normal", {0, 0, -1}}})},
     same_as(kNoLight)},
    {"cone_of_180_degrees",
     {"limiting cone angle"},
     "spot > 0",
     {with(cone(2), {{"position", {0, 0, 5}}, {"normal", {0, 0, -1}}})},
     same_as({{"SpotLights.lights[].axis", {0, 0, 1}}})},
    {"negative_cosine_in_a_wide_cone",
     {"behind a wide cone"},
     "spot > 0",
     {with(cone(2), {{"position", {0, 0, 5}}, {"normal", {0, 0, -1}}, {"SpotLights.lights[].exponent", {5}}}),
      with(cone(2),
           {{"position", {5, 0, 1}}, {"normal", {-1, 0, 0}}, {"SpotLights.lights[].exponent", {0.5}}})},
     same_as(kNoLight)},
    // 0.3 % of the angle to either side of the edge
    {"tiny_cone_inside",
     {"tiny cone"},
     "spot > 0",
     {with(cone(kTinyOneMinusCosine), off_axis(kTiny * 0.997))},
     same_as(kWideCone)},
    {"tiny_cone_outside",
     {"tiny cone"},
     "spot > 0",
     {with(cone(kTinyOneMinusCosine), off_axis(kTiny * 1.003))},
     same_as(kNoLight)},
    {"behind_the_light",
     {"outside the shadow map"},
     "directional_shadows + spot_shadows > 0",
     {dark_map_at(-0.5, -0.5, -0.5, -1), dark_map_at(-5e5, -5e5, -5e5, -1e6), dark_map_at(0, 0, 0, 0),
      dark_map_at(0.5, 0.5, 0.5, 0)},
     same_as({{"shadowMaps", {1}}}),
     kShadowFeatures},
    {"beside_the_map",
     {"outside the shadow map"},
     "directional_shadows + spot_shadows > 0",
     {dark_map_at(1.001, 0.5, 0.5, 1), dark_map_at(0.5, -0.001, 0.5, 1), dark_map_at(0.5, 0.5, 1.001, 1),
      dark_map_at(0.5, 0.5, -0.001, 1), dark_map_at(1e6, 1e6, 1e6, 1e-6)},
     same_as({{"shadowMaps", {1}}}),
     kShadowFeatures},
    {"point_at_the_light",
     {"outside the shadow map"},
     "point_shadows > 0",
     {dark_map_at(0, 0, 0, 1)},
     same_as({{"shadowMaps", {1}}}),
     kShadowFeatures},
    {"in_the_shadow",
     {"shadow maps"},
     "directional_shadows + spot_shadows > 0",
     {dark_map_at(0.5, 0.5, 0.5, 1), dark_map_at(0, 0, 1, 1), dark_map_at(1, 1, 1e-6, 1),
      dark_map_at(1e-30, 2e-30, 2e-30, 2e-30)},
     same_as(kNoLight),
     kShadowFeatures},
    {"in_the_shadow_of_a_cube",
     {"shadow maps"},
     "point_shadows > 0",
     {dark_map_at(1, 0, 0, 1), dark_map_at(-1, 1, 1, 1), dark_map_at(0, 1, 0.5, 1),
      dark_map_at(0, -1e6, 0, 1), dark_map_at(0.5, 0, 1, 1), dark_map_at(0, 0, -1e-6, 1)},
     same_as(kNoLight),
     kShadowFeatures},
    // Each quality value with guards of its own.
    {"zero_normal_ordinary",
     {"zero vector"},
     "point + spot > 0 && guards == ordinary",
     {{{"normal", {0, 0, 0}}}},
     same_as(kNoLight),
     kQuality},
    {"ordinary_lengths",
     {"tiny vector", "huge vector"},
     "point + spot > 0 && guards == ordinary",
     {{{"normal", {1e-15, 2e-15, 2e-15}}}, {{"normal", {3e14, 6e14, 6e14}}}},
     same_as({{"normal", {1, 2, 2}}}, kByDirection),
     kQuality},
    {"light_at_the_surface_ordinary",
     {"light at the surface"},
     "point + spot > 0 && guards == ordinary",
     {light_at(0, 0, -5)},
     same_as(kNoLight),
     kQuality},
    {"light_at_the_surface_by_angle",
     {"light at the surface"},
     "spot > 0 && spot_edge == angle",
     {light_at(0, 0, -5)},
     same_as(kNoLight),
     kQuality},
    {"cone_of_0_degrees_by_cosine",
     {"limiting cone angle"},
     "spot > 0 && spot_edge != one_minus_cosine",
     {cone(0), with(cone(0), off_axis(0.3)),
      with(cone(0), {{"SpotLights.lights[].axis", {0, 0, -1.000001}}})},
     same_as(kNoLight),
     kQuality},
    {"tiny_cone_by_angle",
     {"tiny cone"},
     "spot > 0 && spot_edge == angle",
     {with(cone(kTinyOneMinusCosine), off_axis(kTiny * 1.003))},
     same_as(kNoLight),
     kQuality},
    {"shininess_zero_without_logarithm",
     {"zero to the power of zero"},
     "directional > 0 && fog == none && (power == near_exact || power == squaring || power == gaussian || "
     "power == lyon || power == schlick)",
     {with({{"Material.shininess", {0}}, {"Material.diffuse", {0, 0, 0}}}, light_from(0, 0, 1)),
      with({{"Material.shininess", {0}}, {"Material.diffuse", {0, 0, 0}}, {"position", {-9, 0, 9}}},
           light_from(0.8, 0, 0.6))},
     is_color({1.25, 1.25, 1.25, 1}),
     kHighlightQuality},
    {"negative_base_near_exact",
     {"power of a negative base"},
     "directional > 0 && power == near_exact && viewer == local",
     {with({{"position", {-9, 0, 9}}}, light_from(0.8, 0, 0.6)),
      with({{"position", {-9, 0, 9}}, {"Material.shininess", {0.5}}}, light_from(0.8, 0, 0.6))},
     same_as(kNoHighlight),
     kHighlightQuality},
    {"negative_base_squaring",
     {"power of a negative base"},
     "directional > 0 && (power == squaring || power == schlick) && viewer == local",
     {with({{"position", {-9, 0, 9}}}, light_from(0.8, 0, 0.6))},
     same_as(kNoHighlight),
     kHighlightQuality},
    {"negative_base_lyon",
     {"power of a negative base"},
     "directional > 0 && power == lyon && viewer == local",
     {with({{"position", {-9, 0, 9}}}, light_from(0.8, 0, 0.6))},
     same_as(kNoHighlight),
     kHighlightQuality},
    {"near_exact",
     {"sharp highlight"},
     "directional > 0 && power == near_exact && fog == none",
     sharp_highlights(),
     is_sharp_to_rounding(),
     kHighlightQuality},
    {"shininess_of_a_million",
     {"huge numbers"},
     "directional + point + spot > 0 && specular != none",
     {{{"Material.shininess", {1e6}}}, {{"Material.shininess", {1e6}}, {"position", {-9, 0, 9}}}},
     robust(),
     kHighlightQuality},
    {"interpolated_share_below_zero",
     {"interpolated out of range"},
     "point + spot > 0 && shading == hybrid",
     {{{"lightRays[]", {0, 0, 1, -1e-7}}}},
     same_as({{"lightRays[]", {0, 0, 1, 0}}})},
    {"normal_longer_than_one_as_it_is",
     {"interpolated out of range"},
     "directional > 0 && normal == interpolated && shading == fragment",
     {{{"eyeNormal", {0, 0, 1.000001}}, {"Material.shininess", {1e6}}, {"Material.diffuse", {0, 0, 0}}}},
     same_as({{"eyeNormal", {0, 0, 1}}}),
     {"directional", "specular", "normal"}},
    {"normals_cancel_as_they_are",
     {"zero vector"},
     "directional + point + spot > 0 && normal == interpolated",
     {{{"eyeNormal", {0, 0, 0}}}},
     same_as(kNoLight),
     {"directional", "point", "spot", "specular", "shading", "normal"}},
    {"step_beyond",
     {"fog that is a step"},
     "fog == linear",
     {fog_from_to(6, 6)},
     same_as(fog_from_to(5e5, 1e6))},
    {"step_before",
     {"fog that is a step"},
     "fog == linear",
     {fog_from_to(4, 4), fog_from_to(5, 5)},
     is_color(kFogColor)},
    {"very_far",
     {"fog very far away"},
     "fog != none",
     {{{"position", {0, 0, -1e20}}, {"Fog.density", {1}}},
      {{"position", {1e19, 1e20, -1e20}}, {"Fog.density", {1}}}},
     is_color(kFogColor)},
    {"infinite_radiance_in_the_fog",
     {"infinite radiance in fog"},
     "fog != none && shading == vertex",
     {{{"position", {0, 0, -1e6}},
       {"litRadiance", std::vector<double>(3, std::numeric_limits<double>::infinity())}}},
     is_color(kFogColor)},
    {"cosine_of_one",
     {"tone above the top one"},
     "directional > 0 && diffuse == toon && fog == none",
     {with(kOnlyLights, light_from(0, 0, 1)), with(kOnlyLights, light_from(0, 0, 1.0000001))},
     is_color({0.75, 0.75, 0.75, 1})},
    {"beside_a_band_edge",
     {"edge between two tones"},
     "directional > 0 && diffuse == toon && fog == none",
     {band_edge(1, -1), band_edge(1, 0), band_edge(1, 1), band_edge(2, -1), band_edge(2, 0), band_edge(2, 1),
      band_edge(3, -1), band_edge(3, 0), band_edge(3, 1), band_edge(4, -1)},
     is_neighbouring_band()},
    {"interpolated_below_zero",
     {"interpolated out of range"},
     "directional + point + spot > 0 && shading == vertex",
     {{{"litRadiance", {-1e-7, -1e-7, -1e-7}}}},
     same_as({{"litRadiance", {0, 0, 0}}})},
    {"normal_longer_than_one",
     {"interpolated out of range"},
     "directional + point + spot > 0 && shading == fragment",
     {{{"eyeNormal", {0, 0, 1.000001}}}},
     same_as({{"eyeNormal", {0, 0, 1}}})},
    {"half_float",
     {"too bright for the target"},
     "output_range == half_float",
     bright_surfaces(),
     fits_half_float(),
     kWithRange},
    {"display",
     {"too bright for the target"},
     "output_range == display",
     bright_surfaces(),
     fits_display(),
     kWithRange},
    {"depth_offsets",
     {"depth out of range", "broken depth promise"},
     "depth != default && depth != early",
     depths(),
     keeps_depth_promise(),
     {"depth"}},
};

/// Machines that make the largest errors allowed leave every tolerance: all that is demanded of them is what
/// is demanded of every case.
bool has_tolerance(sanitize::Machine machine) {
    return machine != sanitize::Machine::errors_up && machine != sanitize::Machine::errors_down;
}

/// What every case demands.
std::vector<std::string> general_faults(const Shaded& shaded) {
    std::vector<std::string> faults = shaded.traps;
    for (const double channel : shaded.color)
        if (!(channel >= 0 && channel <= std::numeric_limits<float>::max()))
            faults.push_back(fmt::format("a channel is {}", channel));
    return faults;
}

}  // namespace

const std::vector<Case>& lit_cases() {
    static const std::vector<Case> all = [] {
        std::vector<Case> cases = kCases;
        for (std::vector<Case>& part : std::vector{model_cases(), surface_cases()})
            std::move(part.begin(), part.end(), std::back_inserter(cases));
        return cases;
    }();
    return all;
}

bool is_about(const Case& tested, const HardCase& hard) {
    return std::find(tested.about.begin(), tested.about.end(), hard.name) != tested.about.end();
}

std::vector<CaseFault> faults_of(const Case& tested, const Overlay& overlay, std::size_t most) {
    const LitUnderTest lit(tested.where, tested.features, overlay, 0, tested.family);
    std::vector<CaseFault> faults;
    if (lit.size() == 0) faults.push_back({"", 0, 0, sanitize::Machine::ieee, "no key is concerned"});
    for (std::size_t permutation = 0; permutation < lit.size(); ++permutation)
        for (std::size_t point = 0; point < tested.points.size(); ++point)
            for (const sanitize::Machine machine : sanitize::kMachines) {
                if (sanitize::options_of(machine).is_half) continue;  // the library says highp throughout
                const Shaded shaded = lit.shade(permutation, tested.points[point], machine);
                std::vector<std::string> found = general_faults(shaded);
                if (has_tolerance(machine)) {
                    const std::string failed =
                        tested.check({lit, permutation, tested.points[point], machine, shaded});
                    if (!failed.empty()) found.push_back(failed);
                }
                for (const std::string& fault : found)
                    faults.push_back({lit.key(permutation), permutation, point, machine, fault});
                if (faults.size() >= most) return faults;
            }
    return faults;
}

void PrintTo(const CaseFault& fault, std::ostream* out) {
    *out << fmt::format("{}, point {}, {}: {}", fault.key, fault.point, sanitize::name_of(fault.machine),
                        fault.text);
}

}  // namespace gobo
