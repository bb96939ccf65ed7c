// The oracle tested by itself: closed forms, edges, limits, symmetries.
#include "lab/oracle/oracle.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo::oracle {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// A few dozen double operations of size 1, each off by at most 1.1e-16.
constexpr double kRounding = 1e-13;

double one_minus_cosine(double degrees) {
    return 1 - std::cos(degrees * kDegree);
}

/// The direction at an angle from the normal (0, 0, 1), in the plane y = 0.
glm::dvec3 tilted(double degrees) {
    return {std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree)};
}

/// A white surface at (0, 0, -5) that faces the viewer; nothing but what a test adds lights it.
Scene white_scene() {
    Scene scene;
    scene.material.diffuse = glm::dvec3(1);
    scene.material.specular = glm::dvec3(1);
    scene.material.strength = 1;
    scene.toon_levels = 4;
    return scene;
}
constexpr SurfacePoint kFacing{{0, 0, -5}, {0, 0, 1}};

double red(const Model& model, const Scene& scene, const SurfacePoint& point = kFacing) {
    Decisions decisions;
    return lit_radiance(model, scene, point, decisions).value.r;
}

/// The radiance under one white directional light at an angle from the normal.
double under_light(const Model& model, double degrees, double shininess = 0) {
    Scene scene = white_scene();
    scene.material.shininess = shininess;
    scene.directional = {{tilted(degrees), glm::dvec3(1)}};
    return red(model, scene);
}

struct Form {
    std::string name;
    Model model;
    double degrees;
    double shininess;
    double expected;
};

TEST(Oracle, GivesTheClosedFormOfEachResponse) {
    const Model lambert{.directional = 1};
    const Model toon{.directional = 1, .diffuse = Diffuse::toon};
    const Model phong{.directional = 1, .specular = Specular::phong};
    const Model blinn{.directional = 1, .specular = Specular::blinn};
    const std::vector<Form> forms = {
        {"lambert: light from the front", lambert, 0, 0, 1},
        {"lambert: light at 60 degrees", lambert, 60, 0, 0.5},
        {"lambert: light from behind", lambert, 120, 0, 0},
        {"toon, 4 levels: cosine 1 is in the top band", toon, 0, 0, 0.75},
        {"toon: cosine 0.866 is in the top band", toon, 30, 0, 0.75},
        {"toon: cosine 0.64 is in the band of 1/2", toon, 50, 0, 0.5},
        {"toon: cosine 0.34 is in the band of 1/4", toon, 70, 0, 0.25},
        {"toon: cosine 0.17 is in the lowest band", toon, 80, 0, 0},
        {"phong: r is as far from v as s is from n", phong, 60, 3, 0.5 + 0.125},
        {"phong: nothing from behind", phong, 120, 3, 0},
        {"phong: at exponent 0 every lit direction shines", phong, 60, 0, 0.5 + 1},
        {"blinn: h is half as far", blinn, 60, 3, 0.5 + std::pow(std::cos(30 * kDegree), 3)},
        {"blinn: nothing from behind though h would be in front", blinn, 100, 3, 0},
        {"blinn: at exponent 0 every lit direction shines", blinn, 60, 0, 0.5 + 1},
    };
    for (const Form& form : forms)
        EXPECT_NEAR(under_light(form.model, form.degrees, form.shininess), form.expected, kRounding)
            << form.name;
}

TEST(Oracle, AddsMaterialAndAmbientLight) {
    Scene scene = white_scene();
    scene.material.emission = {0.5, 0.25, 0};
    scene.material.ambient = {0.5, 1, 0.25};
    scene.ambient = {2, 3, 4};
    Decisions decisions;
    const glm::dvec3 value = lit_radiance({}, scene, kFacing, decisions).value;
    EXPECT_EQ(value, glm::dvec3(1.5, 3.25, 1));
}

TEST(Oracle, ScalesTheHighlightByStrengthAndSpecularColorAlone) {
    Scene scene = white_scene();
    scene.material.diffuse = glm::dvec3(0);
    scene.material.specular = glm::dvec3(0.5);
    scene.material.strength = 3;
    scene.material.shininess = 10;
    scene.directional = {{{0, 0, 1}, glm::dvec3(2)}};
    EXPECT_NEAR(red({.directional = 1, .specular = Specular::blinn}, scene), 3, kRounding);
}

TEST(Oracle, WeakensLightByDistance) {
    EXPECT_DOUBLE_EQ(attenuation({1, 0, 0}, 7), 1);
    EXPECT_DOUBLE_EQ(attenuation({2, 3, 4}, 5), 1.0 / (2 + 15 + 100));
    EXPECT_DOUBLE_EQ(attenuation({0, 0, 0}, 5), 1e18);
    Scene scene = white_scene();
    scene.point = {{{0, 0, -3}, glm::dvec3(6), {0, 0, 1}}};
    EXPECT_NEAR(red({.point = 1}, scene), 6.0 / 4, kRounding) << "2 in front of the surface";
}

struct Cone {
    std::string name;
    double inner, outer, exponent;  ///< angles in degrees
    double at;
    double expected;
};

TEST(Oracle, ShapesTheConeOfASpotLight) {
    const double midway = std::acos(1 - (one_minus_cosine(20) + one_minus_cosine(40)) / 2) / kDegree;
    const std::vector<Cone> cones = {
        {"on the axis", 20, 40, 8, 0, 1},
        {"inside the inner angle only the exponent counts", 20, 40, 2, 10,
         std::pow(std::cos(10 * kDegree), 2)},
        {"midway in one minus cosine a quarter is left", 20, 40, 0, midway, 0.25},
        {"outside", 20, 40, 0, 41, 0},
        {"hard edge, inside", 30, 30, 0, 29.9, 1},
        {"hard edge, outside", 30, 30, 0, 30.1, 0},
        {"outer angle 0 is nothing", 0, 0, 0, 0.1, 0},
        {"90 degrees is the half space, inside", 90, 90, 0, 89.9, 1},
        {"90 degrees is the half space, outside", 90, 90, 0, 90.1, 0},
        {"180 degrees is everything", 180, 180, 0, 180, 1},
        {"a wide cone with an exponent is dark behind", 180, 180, 1, 120, 0},
        {"a cone of 1e-4 radians", 1e-4 / kDegree, 1e-4 / kDegree, 0, 0.997e-4 / kDegree, 1},
    };
    for (const Cone& cone : cones) {
        SpotLight light;
        light.inner_one_minus_cosine = one_minus_cosine(cone.inner);
        light.outer_one_minus_cosine = one_minus_cosine(cone.outer);
        light.exponent = cone.exponent;
        Decisions decisions;
        // Around 1e-4 radians a one minus cosine in double is good to 2e-8 of itself; the edge is 3e-3 away.
        EXPECT_NEAR(cone_weight(light, cone.at * kDegree, decisions), cone.expected, kRounding) << cone.name;
    }
}

struct Foggy {
    std::string name;
    Fog kind;
    double near, far, density;
    double distance;
    double expected;
};

TEST(Oracle, LetsThroughWhatEachFogSays) {
    const std::vector<Foggy> fogs = {
        {"none", Fog::none, 0, 0, 9, 100, 1},
        {"linear: before near", Fog::linear, 2, 10, 0, 1, 1},
        {"linear: a quarter of the way", Fog::linear, 2, 10, 0, 4, 0.75},
        {"linear: beyond far", Fog::linear, 2, 10, 0, 11, 0},
        {"linear: near = far, before", Fog::linear, 5, 5, 0, 4.9, 1},
        {"linear: near = far, there", Fog::linear, 5, 5, 0, 5, 0},
        {"linear: near = far = 0", Fog::linear, 0, 0, 0, 0, 0},
        {"exponential: density z = 1", Fog::exponential, 0, 0, 0.25, 4, 1 / std::numbers::e},
        {"exponential: density 0", Fog::exponential, 0, 0, 0, 4, 1},
        {"exponential squared: density z = 2", Fog::exponential_squared, 0, 0, 0.5, 4, std::exp(-4.0)},
    };
    for (const Foggy& row : fogs) {
        Decisions decisions;
        const FogParameters fog{glm::dvec3(1), row.density, row.near, row.far};
        EXPECT_NEAR(fog_factor(row.kind, fog, row.distance, decisions), row.expected, kRounding) << row.name;
    }
    EXPECT_DOUBLE_EQ(fog_distance(FogDistance::radial, {2, 3, -6}), 7);
    EXPECT_DOUBLE_EQ(fog_distance(FogDistance::planar, {2, 3, -6}), 6);
}

TEST(Oracle, BlendsFogOverTheRadiance) {
    Scene scene = white_scene();
    scene.fog = {{1, 0, 0}, 0, 0, 8};
    Decisions decisions;
    const Seen seen =
        seen_through_fog({.fog = Fog::linear}, scene, {0, 0, -2}, {0, 4, 0}, {0, 4, 0}, decisions);
    EXPECT_EQ(seen.value, glm::dvec3(0.25, 3, 0));
    EXPECT_EQ(seen.largest, glm::dvec3(1, 4, 0));
}

TEST(Oracle, MovesDepthToThePromisedSideOnly) {
    struct Row {
        Depth kind;
        double offset, depth;
        std::optional<double> expected;
    };
    const std::vector<Row> rows = {{Depth::untouched, 0.25, 0.5, std::nullopt},
                                   {Depth::any, 0.25, 0.5, 0.75},
                                   {Depth::any, -0.75, 0.5, 0.0},
                                   {Depth::any, 0.75, 0.5, 1.0},
                                   {Depth::greater, 0.25, 0.5, 0.75},
                                   {Depth::greater, -0.25, 0.5, 0.5},
                                   {Depth::greater, 0.75, 0.5, 1.0},
                                   {Depth::less, -0.25, 0.5, 0.25},
                                   {Depth::less, 0.25, 0.5, 0.5},
                                   {Depth::less, -0.75, 0.5, 0.0},
                                   {Depth::unchanged, 0.25, 0.5, 0.5}};
    for (const Row& row : rows) {
        Scene scene;
        scene.depth_offset = row.offset;
        EXPECT_EQ(written_depth({.depth = row.kind}, scene, row.depth), row.expected)
            << static_cast<int>(row.kind) << " moved by " << row.offset;
    }
}

// ---- Edges
// ---------------------------------------------------------------------------------------------------

TEST(Oracle, GivesNoLightWhereADirectionIsMissing) {
    Scene scene = white_scene();
    const Model model{.directional = 1, .specular = Specular::blinn};
    scene.directional = {{glm::dvec3(0), glm::dvec3(1)}};
    EXPECT_EQ(red(model, scene), 0) << "zero light direction";
    scene.directional = {{{0, 0, 1}, glm::dvec3(1)}};
    EXPECT_EQ(red(model, scene, {{0, 0, -5}, {0, 0, 0}}), 0) << "zero normal";
    scene.point = {{kFacing.position, glm::dvec3(1), {1, 0, 0}}};
    scene.directional.clear();
    EXPECT_EQ(red({.point = 1}, scene), 0) << "light at the surface point";
}

TEST(Oracle, HasNoHighlightFromALightExactlyBehindTheViewersRay) {
    EXPECT_EQ(highlight_angle(Specular::blinn, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}), std::acos(0.0));
    EXPECT_NEAR(lobe(Power::exact, one_minus_cosine_of(std::acos(0.0)), 10), 0, kRounding);
}

TEST(Oracle, TellsHowNearADecisionIsAndGivesTheOtherSideWithinTheEdge) {
    const Model toon{.directional = 1, .diffuse = Diffuse::toon};
    Scene scene = white_scene();
    const double just_below = std::acos(0.5 - 4e-6) / kDegree;
    scene.directional = {{tilted(just_below), glm::dvec3(1)}};
    Decisions plain;
    EXPECT_EQ(lit_radiance(toon, scene, kFacing, plain).value.r, 0.25);
    EXPECT_EQ(plain.open(), 1);
    EXPECT_NEAR(plain.nearest(), 4e-6, 1e-12);
    Decisions other(1);
    EXPECT_EQ(lit_radiance(toon, scene, kFacing, other).value.r, 0.5);
    scene.directional = {{tilted(50), glm::dvec3(1)}};
    Decisions far_from_edge(1);
    EXPECT_EQ(lit_radiance(toon, scene, kFacing, far_from_edge).value.r, 0.5) << "nothing to flip";
    EXPECT_EQ(far_from_edge.open(), 0);
}

TEST(Oracle, DecidesAtTheHorizonOnlyWhereAHighlightJumps) {
    Scene scene = white_scene();
    scene.directional = {{tilted(90), glm::dvec3(1)}};
    Decisions lambert;
    EXPECT_NEAR(lit_radiance({.directional = 1}, scene, kFacing, lambert).value.r, 0, kRounding);
    EXPECT_EQ(lambert.open(), 0);
    Decisions blinn;
    const Radiance jumping =
        lit_radiance({.directional = 1, .specular = Specular::blinn}, scene, kFacing, blinn);
    EXPECT_EQ(jumping.terms.size(), 1U);
    EXPECT_EQ(blinn.open(), 1);
}

// ---- Limits
// --------------------------------------------------------------------------------------------------

TEST(Oracle, ApproachesSimplerModelsInTheLimit) {
    Scene near = white_scene();
    near.point = {{glm::dvec3(3, 4, 0) * 1e9, glm::dvec3(1), {1, 0, 0}}};
    Scene scene = white_scene();
    scene.directional = {{{0.6, 0.8, 0}, glm::dvec3(1)}};
    const SurfacePoint point{{0, 0, -5}, {0.6, 0.8, 0.5}};
    // The surface is 1e-9 of the distance away from the origin, to which the directional light refers.
    EXPECT_NEAR(red({.point = 1}, near, point), red({.directional = 1}, scene, point), 2e-9)
        << "a point light far away is a directional light";

    Scene spot = white_scene();
    spot.spot = {{{{1, 2, 0}, glm::dvec3(1), {1, 0, 0.5}}, {0, -1, 0}, 0, 2, 2}};
    Scene bare = white_scene();
    bare.point = {spot.spot.front()};
    EXPECT_EQ(red({.spot = 1}, spot, point), red({.point = 1}, bare, point)) << "a spot light of 180 degrees";

    scene.toon_levels = 1'000'000;
    const Model toon{.directional = 1, .diffuse = Diffuse::toon};
    EXPECT_NEAR(red(toon, scene, point), red({.directional = 1}, scene, point), 1e-6)
        << "toon of many levels";
}

TEST(Oracle, MakesBlinnsHighlightAsWideAsPhongsAtFourTimesTheExponent) {
    // h is half as far from n as r is from v, and cos(a)^m is exp(-m a^2 / 2) to fourth order in a.
    for (const double degrees : {0.5, 1.0, 2.0}) {
        const double phong = lobe(Power::exact, one_minus_cosine_of(degrees * kDegree), 100);
        const double blinn = lobe(Power::exact, one_minus_cosine_of(degrees / 2 * kDegree), 400);
        const double fourth_order = 100 * std::pow(degrees * kDegree, 4) / 12;
        EXPECT_NEAR(phong, blinn, 1.01 * fourth_order) << degrees << " degrees";
    }
}

// ---- Symmetries
// ------------------------------------------------------------------------------------------------

Scene crowded_scene() {
    Scene scene = white_scene();
    scene.material.shininess = 20;
    scene.directional = {{glm::normalize(glm::dvec3(1, 2, 3)), {1, 2, 3}}, {{0, 0.6, 0.8}, {0.5, 0.25, 1}}};
    scene.point = {{{1, 1, -3}, {4, 5, 6}, {1, 0.5, 0.25}}, {{-2, 1, -4}, {1, 1, 2}, {0, 1, 0}}};
    scene.spot = {
        {{{0, 2, -2}, {9, 8, 7}, {1, 0, 0.1}}, glm::normalize(glm::dvec3(0, -2, -3)), 3, 0.05, 0.4}};
    return scene;
}
constexpr Model kCrowded{.directional = 2, .point = 2, .spot = 1, .specular = Specular::blinn};
constexpr SurfacePoint kTilted{{0.5, 0.25, -5}, {0.3, 0.4, 1.5}};

TEST(Oracle, DoesNotDependOnTheOrderOfLights) {
    Scene scene = crowded_scene();
    const double before = red(kCrowded, scene, kTilted);
    std::swap(scene.directional[0], scene.directional[1]);
    std::swap(scene.point[0], scene.point[1]);
    EXPECT_NEAR(red(kCrowded, scene, kTilted), before, before * kRounding);
}

TEST(Oracle, IsLinearInTheLights) {
    const Scene scene = crowded_scene();
    Scene doubled = scene;
    doubled.point[0].color *= 2.0;
    Scene twice = scene;
    twice.point.push_back(scene.point[0]);
    const double expected = red(kCrowded, doubled, kTilted);
    EXPECT_NEAR(red(kCrowded, twice, kTilted), expected, expected * kRounding);
    Scene dark = scene;
    dark.point.push_back({{1, 2, 3}, glm::dvec3(0), {1, 0, 0}});
    EXPECT_EQ(red(kCrowded, dark, kTilted), red(kCrowded, scene, kTilted)) << "a light of no intensity";
}

TEST(Oracle, DoesNotChangeWhenEverythingTurnsTogether) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(1, -2, 0.5)));
    Scene scene = crowded_scene();
    for (DirectionalLight& light : scene.directional) light.direction = turn * light.direction;
    for (PointLight& light : scene.point) light.position = turn * light.position;
    for (SpotLight& light : scene.spot) {
        light.position = turn * light.position;
        light.axis = turn * light.axis;
    }
    const SurfacePoint turned{turn * kTilted.position, turn * kTilted.normal};
    const double expected = red(kCrowded, crowded_scene(), kTilted);
    EXPECT_NEAR(red(kCrowded, scene, turned), expected, expected * kRounding);
    // Planar fog alone knows where the viewer looks.
    EXPECT_NEAR(fog_distance(FogDistance::radial, turned.position),
                fog_distance(FogDistance::radial, kTilted.position), kRounding * 10);
}

TEST(Oracle, DoesNotDependOnTheLengthOfTheNormal) {
    SurfacePoint longer = kTilted;
    longer.normal *= 1000.0;
    const double expected = red(kCrowded, crowded_scene(), kTilted);
    EXPECT_NEAR(red(kCrowded, crowded_scene(), longer), expected, expected * kRounding);
}

// ---- Keys
// --------------------------------------------------------------------------------------------------------

tl::expected<Model, std::string> model_of_text(const std::string& name, const std::string& key) {
    const Result<Family> family = read_family("name = '" + name + R"('
vertex = 'a.vert'
fragment = 'a.frag'
[features.point]
role = 'effect'
count = [0, 8]
constant = 'POINT_LIGHTS'
[features.fog]
role = 'effect'
values = ['none', 'linear', 'layered']
[features.wet]
role = 'effect'
values = ['no', 'yes']
)",
                                              "lit.toml");
    if (!family) return tl::unexpected(to_text(family.error().front()));
    const Result<Key> parsed = parse_key(*family, key);
    if (!parsed) return tl::unexpected(to_text(parsed.error().front()));
    return model_of(*family, *parsed);
}

TEST(Oracle, ReadsItsModelFromAKeyOrSaysWhyThereIsNone) {
    const auto model = model_of_text("lit", "point=3 fog=linear");
    ASSERT_TRUE(model.has_value()) << model.error();
    EXPECT_EQ(model->point, 3);
    EXPECT_EQ(model->fog, Fog::linear);
    EXPECT_EQ(model->diffuse, Diffuse::lambert);
    EXPECT_EQ(model->lights(), 3);
    EXPECT_EQ(model_of_text("lit", "fog=layered").error(), "the oracle has no equation for fog=layered");
    EXPECT_EQ(model_of_text("lit", "wet=yes").error(), "the oracle has no equation for wet=yes");
    EXPECT_EQ(model_of_text("game", "default").error(), "the oracle does not know the family 'game'");
}

}  // namespace
}  // namespace gobo::oracle
