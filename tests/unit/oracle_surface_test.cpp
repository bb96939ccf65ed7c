// The oracle's surface models by themselves: closed forms, edges, limits, symmetries of tones, sides, tables
// of materials, colours, and of the light around a surface.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "lab/oracle/oracle.hpp"

namespace gobo::oracle {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// A few dozen double operations of size 1, each off by at most 1.1e-16.
constexpr double kRounding = 1e-13;
constexpr SurfacePoint kFacing{{0, 0, -5}, {0, 0, 1}};

glm::dvec3 tilted(double degrees) {
    return {std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree)};
}

Scene white_scene() {
    Scene scene;
    scene.material.ambient = scene.material.diffuse = scene.material.specular = glm::dvec3(1);
    scene.toon_levels = 4;
    return scene;
}

glm::dvec3 radiance(const Model& model, const Scene& scene, const SurfacePoint& point = kFacing) {
    Decisions decisions;
    return lit_radiance(model, scene, point, decisions).value;
}

/// Tones under white lights at these angles from the normal.
double toned(Diffuse diffuse, const std::vector<double>& degrees, double intensity = 1) {
    Scene scene = white_scene();
    for (const double angle : degrees) scene.directional.push_back({tilted(angle), glm::dvec3(intensity)});
    Model model{.directional = static_cast<int>(degrees.size()), .diffuse = diffuse};
    return radiance(model, scene).r;
}

TEST(OracleSurface, GivesTheToneOfEachBandAndThreshold) {
    struct Row {
        std::string name;
        Diffuse diffuse;
        std::vector<double> degrees;
        double expected;
    };
    const std::vector<Row> rows = {
        {"ceil: cosine 1", Diffuse::toon_ceil, {0}, 1},
        {"ceil: cosine 0.64", Diffuse::toon_ceil, {50}, 0.75},
        {"ceil: cosine 0.17 is in the lowest band", Diffuse::toon_ceil, {80}, 0.25},
        {"ceil: grazing light is still in the lowest band", Diffuse::toon_ceil, {89.9}, 0.25},
        {"ceil: nothing from behind", Diffuse::toon_ceil, {100}, 0},
        {"thresholds: above 0.95", Diffuse::toon_thresholds, {10}, 1},
        {"thresholds: above 0.5", Diffuse::toon_thresholds, {45}, 0.6},
        {"thresholds: above 0.25", Diffuse::toon_thresholds, {70}, 0.4},
        {"thresholds: below all", Diffuse::toon_thresholds, {80}, 0},
        {"thresholds: tones add", Diffuse::toon_thresholds, {70, -70}, 0.8},
        {"thresholds: no more than the brightest", Diffuse::toon_thresholds, {45, -45, 70}, 1},
        {"thresholds: a light without a tone limits nothing", Diffuse::toon_thresholds, {80, 70}, 0.4},
    };
    for (const Row& row : rows)
        EXPECT_NEAR(toned(row.diffuse, row.degrees), row.expected, kRounding) << row.name;
    EXPECT_NEAR(toned(Diffuse::toon_thresholds, {0, 45}, 3), 3, kRounding) << "the brightest light counts";
}

TEST(OracleSurface, LiesBetweenTheBandsOfFloorAndCeil) {
    for (double degrees = 1; degrees < 90; degrees += 3.7) {
        const double cosine = std::cos(degrees * kDegree);
        EXPECT_LE(toned(Diffuse::toon, {degrees}), cosine) << degrees;
        EXPECT_GE(toned(Diffuse::toon_ceil, {degrees}), cosine) << degrees;
    }
}

TEST(OracleSurface, PassesTheColorThroughUnlit) {
    Scene scene = white_scene();
    scene.material.emission = glm::dvec3(9);
    scene.material.diffuse = {0.5, 0.25, 1};
    scene.ambient = glm::dvec3(7);
    SurfacePoint point = kFacing;
    point.color = {0.5, 1, 0.25, 0.75};
    EXPECT_EQ(radiance({.lighting = Lighting::unlit}, scene, point), glm::dvec3(0.5, 0.25, 1));
    const Model tinted{.lighting = Lighting::unlit, .vertex_color = VertexColor::modulate};
    EXPECT_EQ(radiance(tinted, scene, point), glm::dvec3(0.25, 0.25, 0.25));
    EXPECT_EQ(alpha_of(tinted, {}, point), 0.75);
    EXPECT_EQ(alpha_of({}, {}, point), 1);
}

TEST(OracleSurface, TintsScatteredLightButNoHighlightAndNoEmission) {
    Scene scene = white_scene();
    scene.material.emission = glm::dvec3(0.5);
    scene.ambient = glm::dvec3(2);
    scene.directional = {{{0, 0, 1}, glm::dvec3(4)}};
    SurfacePoint point = kFacing;
    point.color = {0.25, 1, 0, 1};
    const Model model{.directional = 1, .specular = Specular::blinn, .vertex_color = VertexColor::modulate};
    const glm::dvec3 expected = glm::dvec3(0.5 + 4) + glm::dvec3(0.25, 1, 0) * (2.0 + 4.0);
    EXPECT_LT(glm::length(radiance(model, scene, point) - expected), kRounding);
}

TEST(OracleSurface, ShadesTheBackAsAFrontThatFacesTheOtherWay) {
    Scene scene = white_scene();
    scene.directional = {{tilted(130), glm::dvec3(1)}};
    SurfacePoint back = kFacing;
    back.is_back = true;
    const SurfacePoint turned{{0, 0, -5}, {0, 0, -1}};
    const Model two{.directional = 1, .specular = Specular::phong, .sides = Sides::two};
    EXPECT_EQ(radiance(two, scene, back), radiance(two, scene, turned));
    EXPECT_GT(radiance(two, scene, back).r, 0.6);
    EXPECT_EQ(radiance({.directional = 1}, scene, back).r, 0) << "one side knows no back";
}

TEST(OracleSurface, TakesTheRowOfTheTableOrTheNearest) {
    Scene scene;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        scene.materials[i].shininess = static_cast<double>(i);
    const Model table{.material = MaterialChoice::array};
    const Model pairs{.material = MaterialChoice::array, .sides = Sides::two_materials};
    struct Row {
        int index;
        double one, front, back;
    };
    for (const Row& row : {Row{0, 0, 0, 1}, Row{3, 3, 6, 7}, Row{6, 6, 12, 13}, Row{7, 7, 12, 13},
                           Row{13, 13, 12, 13}, Row{14, 13, 12, 13}, Row{-5, 0, 0, 1}}) {
        SurfacePoint point = kFacing;
        point.material = row.index;
        EXPECT_EQ(material_of(table, scene, point).shininess, row.one) << row.index;
        EXPECT_EQ(material_of(pairs, scene, point).shininess, row.front) << row.index;
        point.is_back = true;
        EXPECT_EQ(material_of(table, scene, point).shininess, row.one) << row.index;
        EXPECT_EQ(material_of(pairs, scene, point).shininess, row.back) << row.index;
    }
}

TEST(OracleSurface, CutsWhatIsBelowTheThreshold) {
    Scene scene;
    scene.cutout_threshold = 0.5;
    const auto is_cut = [&](double opacity, double alpha) {
        SurfacePoint point = kFacing;
        point.opacity = opacity;
        point.color.a = alpha;
        Decisions decisions;
        return is_cut_out({.cutout = Cutout::threshold, .vertex_color = VertexColor::modulate}, scene, point,
                          decisions);
    };
    EXPECT_FALSE(is_cut(1, 0.5)) << "exactly at the threshold";
    EXPECT_FALSE(is_cut(0.75, 0.75));
    EXPECT_TRUE(is_cut(0.6, 0.75));
    Decisions decisions;
    SurfacePoint hole = kFacing;
    hole.opacity = 0;
    EXPECT_FALSE(is_cut_out({}, scene, hole, decisions)) << "no cutout, no holes";
}

// ---- Lights ----------------------------------------------------------------------------------------------

TEST(OracleSurface, TellsTheKindOfALightByItsW) {
    Scene scene = white_scene();
    const glm::dvec3 fading{1, 0.5, 0.25};
    scene.point = {{{1, 2, -3}, {4, 3, 2}, fading}};
    scene.directional = {{tilted(30), {1, 2, 3}}};
    const glm::dvec3 local = radiance({.point = 1}, scene);
    Scene one = scene;
    one.point.clear();
    const glm::dvec3 distant = radiance({.directional = 1}, one);
    const Model either{.directional_or_point = 1};
    for (const double w : {1.0, 0.25, 8.0, -2.0}) {
        Scene other = white_scene();
        other.directional_or_point = {{glm::dvec4(w * glm::dvec3(1, 2, -3), w), {4, 3, 2}, fading}};
        Scene bare = white_scene();
        bare.point = scene.point;
        EXPECT_LT(glm::length(radiance(either, other) - radiance({.point = 1}, bare)), kRounding) << w;
    }
    Scene other = white_scene();
    other.directional_or_point = {{glm::dvec4(7.0 * tilted(30), 0), {1, 2, 3}, fading}};
    EXPECT_LT(glm::length(radiance(either, other) - distant), kRounding);
    EXPECT_GT(glm::length(local), 0);
}

TEST(OracleSurface, KeepsALightsAmbientTermOutsideItsCone) {
    Scene scene = white_scene();
    scene.spot = {{{{0, 0, -3}, glm::dvec3(5), {0, 0, 1}}, {0, 0, 1}, 0, 0.1, 0.1}};  // shines away
    scene.light_ambients = {glm::dvec3(2)};
    EXPECT_NEAR(radiance({.spot = 1, .light_ambient = LightAmbient::each}, scene).r, 2.0 / 4, kRounding)
        << "weakened by the distance of 2 alone";
    EXPECT_EQ(radiance({.spot = 1}, scene).r, 0);
    Scene sun = white_scene();
    sun.directional = {{tilted(120), glm::dvec3(1)}};
    sun.light_ambients = {glm::dvec3(0.25)};
    EXPECT_EQ(radiance({.directional = 1, .light_ambient = LightAmbient::each}, sun).r, 0.25)
        << "from behind";
}

// ---- Environment ----------------------------------------------------------------------------------------

TEST(OracleSurface, SeesTheShareOfTheSkyThatTheIntegralGives) {
    // The sky's cosine-weighted share of the hemisphere over a surface tilted by theta is (1 + cos(theta)) /
    // 2; the book's sine form is what it takes the exact one to be, and both agree at 0, 90 and 180 degrees.
    for (const double degrees : {0.0, 90.0, 180.0})
        EXPECT_NEAR(sky_weight(Hemisphere::sine, degrees * kDegree),
                    sky_weight(Hemisphere::cosine, degrees * kDegree), kRounding);
    EXPECT_NEAR(sky_weight(Hemisphere::sine, 30 * kDegree), 0.75, kRounding);
    EXPECT_NEAR(sky_weight(Hemisphere::sine, 150 * kDegree), 0.25, kRounding);
    EXPECT_NEAR(sky_weight(Hemisphere::cosine, 60 * kDegree), 0.75, kRounding);
    double largest = 0;
    for (double degrees = 0; degrees <= 180; degrees += 0.5) {
        const double sine = sky_weight(Hemisphere::sine, degrees * kDegree);
        largest = std::max(largest, std::abs(sine - sky_weight(Hemisphere::cosine, degrees * kDegree)));
        EXPECT_NEAR(sine + sky_weight(Hemisphere::sine, (180 - degrees) * kDegree), 1, kRounding) << degrees;
    }
    EXPECT_NEAR(largest, (std::numbers::sqrt2 - 1) / 2, 1e-12) << "0.21, at 45 and 135 degrees";
    for (const double length : {0.3, 0.9}) {
        EXPECT_NEAR(sky_weight(Hemisphere::sine, 89.9999 * kDegree, length),
                    sky_weight(Hemisphere::sine, 90.0001 * kDegree, length), 1e-9)
            << "a shortened normal sees no jump at the horizon";
        EXPECT_NEAR(sky_weight(Hemisphere::sine, 0, length), 0.5 + 0.5 * length, kRounding);
    }
}

TEST(OracleSurface, MixesSkyAndGround) {
    const HemisphereLight light{{0, 1, 0}, {1, 2, 4}, {0.5, 0, 0}};
    EXPECT_LT(glm::length(hemisphere_light(Hemisphere::sine, light, {0, 1, 0}).value - light.sky), kRounding);
    EXPECT_LT(glm::length(hemisphere_light(Hemisphere::sine, light, {0, -1, 0}).value - light.ground),
              kRounding);
    EXPECT_LT(glm::length(hemisphere_light(Hemisphere::cosine, light, {0, 0, 0}).value -
                          0.5 * (light.sky + light.ground)),
              kRounding);
}

/// The real basis functions of order 0 to 2 in the coefficients' order, from their definition.
std::array<double, 9> basis(const glm::dvec3& n) {
    const double pi = std::numbers::pi;
    const double c0 = std::sqrt(1 / (4 * pi));
    const double c1 = std::sqrt(3 / (4 * pi));
    const double c2 = std::sqrt(15 / (4 * pi));
    return {c0,
            c1 * n.y,
            c1 * n.z,
            c1 * n.x,
            c2 * n.x * n.y,
            c2 * n.y * n.z,
            c2 / std::sqrt(12) * (3 * n.z * n.z - 1),
            c2 * n.x * n.z,
            c2 / 2 * (n.x * n.x - n.y * n.y)};
}

/// The coefficients of a distant light of power 1 from that direction.
std::array<glm::dvec3, 9> small_light(const glm::dvec3& direction) {
    std::array<glm::dvec3, 9> coefficients;
    const std::array<double, 9> values = basis(direction);
    for (std::size_t i = 0; i < values.size(); ++i) coefficients[i] = glm::dvec3(values[i]);
    return coefficients;
}

TEST(OracleSurface, IsTheConvolutionWithTheCosineLobe) {
    // A_l = pi, 2 pi / 3, pi / 4 are the lobe's own coefficients. The published constants have six digits.
    constexpr std::array<int, 9> kOrder = {0, 1, 1, 1, 2, 2, 2, 2, 2};
    const std::array<double, 3> lobe = {std::numbers::pi, 2 * std::numbers::pi / 3, std::numbers::pi / 4};
    for (const glm::dvec3& n :
         {glm::dvec3(1, 0, 0), glm::dvec3(0.36, 0.48, 0.8), glm::dvec3(-0.6, 0.64, -0.48)})
        for (std::size_t i = 0; i < kOrder.size(); ++i) {
            std::array<glm::dvec3, 9> coefficients{};
            coefficients[i] = glm::dvec3(1);
            const double expected = lobe[static_cast<std::size_t>(kOrder[i])] * basis(n)[i];
            EXPECT_NEAR(irradiance(Harmonics::second, coefficients, n).r, expected, 2e-6) << i;
        }
}

TEST(OracleSurface, GivesPiTimesTheRadianceOfAConstantEnvironment) {
    std::array<glm::dvec3, 9> coefficients{};
    coefficients[0] = glm::dvec3(2 * std::sqrt(4 * std::numbers::pi));
    for (const Harmonics order : {Harmonics::zeroth, Harmonics::first, Harmonics::second})
        EXPECT_NEAR(irradiance(order, coefficients, tilted(33)).r, 2 * std::numbers::pi, 1e-5);
}

TEST(OracleSurface, AddsOneOrderAfterAnother) {
    const auto light = small_light(glm::dvec3(0.6, 0, 0.8));
    std::array<glm::dvec3, 9> few{};
    few[0] = light[0];
    EXPECT_EQ(irradiance(Harmonics::zeroth, light, tilted(20)),
              irradiance(Harmonics::second, few, tilted(20)));
    for (const std::size_t i : {1U, 2U, 3U}) few[i] = light[i];
    EXPECT_EQ(irradiance(Harmonics::first, light, tilted(20)),
              irradiance(Harmonics::second, few, tilted(20)));
}

TEST(OracleSurface, IsNeverNegativeUnderOneSmallBrightLight) {
    // From the light by an angle of cosine c: 1/4 + c/2 + 5 (3 c^2 - 1) / 32, least at c = -8/15.
    HarmonicsLight light;
    light.coefficients = small_light({0, 0, 1});
    const double lowest = std::acos(-8.0 / 15) / kDegree;
    const double expected = 0.25 - 8.0 / 30 + 5 * (3 * 64.0 / 225 - 1) / 32;
    EXPECT_NEAR(irradiance(Harmonics::second, light.coefficients, tilted(lowest)).r, expected, 2e-6);
    EXPECT_LT(irradiance(Harmonics::second, light.coefficients, tilted(lowest)).r, -0.03);
    EXPECT_EQ(harmonics_light(Harmonics::second, light, tilted(lowest)).value, glm::dvec3(0));
    EXPECT_GT(harmonics_light(Harmonics::second, light, tilted(0)).value.r, 1);
}

TEST(OracleSurface, TurnsWithTheProbe) {
    HarmonicsLight light;
    light.coefficients = small_light(glm::dvec3(0.36, 0.48, 0.8));
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.3, glm::dvec3(1, 2, -0.5)));
    HarmonicsLight turned = light;
    turned.to_probe = turn;
    const glm::dvec3 n = tilted(25);
    EXPECT_LT(glm::length(harmonics_light(Harmonics::second, turned, n).value -
                          harmonics_light(Harmonics::second, light, turn * n).value),
              kRounding);
}

/// Interfaces cannot keep a probe's matrix a rotation: what is said to be its largest must hold all the same.
TEST(OracleSurface, KnowsTheLargestOfAProbeThatIsStretched) {
    HarmonicsLight light;
    light.coefficients = small_light(glm::dvec3(0, 0, 1));
    light.to_probe = glm::dmat3(3);
    const AmbientLight seen = harmonics_light(Harmonics::second, light, tilted(0));
    EXPECT_GE(seen.largest.r, seen.value.r);
}

/// Rounding may give any unit normal where a matrix cancels: what is said at one holds at all others.
TEST(OracleSurface, KnowsTheLargestOfEveryNormal) {
    HarmonicsLight light;
    light.coefficients[1] = glm::dvec3(-1);
    light.to_probe = glm::dmat3(0, 1, 0, 0, 0, 0, 0, -1, 0);  // y is n.x - n.z: up to the root of 2
    const glm::dvec3 largest = harmonics_light(Harmonics::first, light, {0, 1, 0}).largest;
    double brightest = 0;
    for (int degrees = 0; degrees < 360; degrees += 5) {
        const double angle = degrees * kDegree;
        const glm::dvec3 n(std::cos(angle), 0, std::sin(angle));
        brightest = std::max(brightest, harmonics_light(Harmonics::first, light, n).value.r);
    }
    EXPECT_GT(brightest, 1.4);
    EXPECT_GE(1.03 * largest.r, brightest);  // the factors reach 1.03, which the roundings count
}

}  // namespace
}  // namespace gobo::oracle
