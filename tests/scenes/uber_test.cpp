// The ubershader draws what each permutation of lit draws: the same pieces, switched at run time.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../unit/image_comparison.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "lab/render/render.hpp"
#include "scene_library.hpp"
#include "software_scene.hpp"
#include "uber_values.hpp"

namespace gobo::scene {
namespace {

/// A torus on a plane, as `gobo render` shows families, from where it fills the picture.
struct Stage {
    std::vector<Object> objects;
    SceneView view;
};

Stage make_stage() {
    Stage stage;
    stage.objects = demo_objects(make_torus(1, 0.4, 24, 12));
    stage.objects[1].mesh = make_plane(12, 8);
    stage.view.width = 40;
    stage.view.height = 30;
    stage.view.view = demo_camera().view();
    stage.view.projection = demo_camera().projection(4.0 / 3);
    return stage;
}

/// A family's permutations, composed once.
class Painter {
  public:
    Painter(const ShippedFamily& shipped, const Stage& stage, const std::vector<Key>& keys) : stage_(stage) {
        const std::vector<std::optional<Key>> wanted(keys.begin(), keys.end());
        auto shaders = shaders_of(shipped.family, shipped.search, std::vector<Draw>(keys.size()), wanted,
                                  Dialect::own, 1);
        EXPECT_TRUE(shaders) << to_text(shaders.error());
        shaders_ = std::move(*shaders);
        permutations_ = shaders_.permutation;
        auto programs = software_programs(shaders_);
        EXPECT_TRUE(programs) << to_text(programs.error());
        programs_ = std::move(*programs);
    }

    /// Everything drawn by the permutation of that number among the keys.
    Image paint(std::size_t number, const std::vector<RenderValue>& values) {
        shaders_.permutation.assign(stage_.objects.size(), permutations_[number]);
        shaders_.draws.resize(stage_.objects.size());
        const auto drawn = draw_in_software(shaders_, programs_, stage_.objects, values, stage_.view);
        EXPECT_TRUE(drawn) << to_text(drawn.error());
        return drawn->color;
    }

  private:
    const Stage& stage_;
    SceneShaders shaders_;
    std::vector<std::optional<std::size_t>> permutations_;
    SoftwarePrograms programs_;
};

int count_of(const Family& family, const Key& key, const char* feature) {
    return key[static_cast<std::size_t>(*family.index_of(feature))];
}

/// Keys that hold every pair of values of what the ubershader switches.
std::vector<Key> switched_cover(const ShippedFamily& lit, const ShippedFamily& uber) {
    Selection selection;
    selection.cover = 2;
    selection.over = {"directional",         "point",         "spot",        "directional_or_point",
                      "directional_shadows", "point_shadows", "spot_shadows"};
    for (const Feature& feature : lit.family.features) {
        const auto index = uber.family.index_of(feature.name);
        const Feature& own = uber.family.features[static_cast<std::size_t>(*index)];
        if (own.index_of("switched")) selection.over.push_back(feature.name);
    }
    selection.where = fmt::format("directional + point + spot + directional_or_point <= {}", kSwitchedLights);
    const auto keys = select(lit.family, selection, "450");
    EXPECT_TRUE(keys) << to_text(keys.error());
    return *keys;
}

/// The value of a shadow's member.
RenderValue shadow_value(int shadow, const char* member, std::vector<double> numbers) {
    return {fmt::format("Shadows.shadows[{}].{}", shadow, member), "", std::move(numbers), {}};
}

/// The values of the family with shadows of two kinds: each darkens half of space or what lies beyond a
/// distance, another for each light, so that none can be taken for another.
std::vector<RenderValue> with_shadows(const Family& lit, const Key& key) {
    std::vector<RenderValue> values = lit.render;
    values.push_back({"shadowMaps", "", {0.5}, {}});
    const int with_one_map = count_of(lit, key, "directional_shadows") + count_of(lit, key, "spot_shadows");
    const int all = with_one_map + count_of(lit, key, "point_shadows");
    for (int i = 0; i < all; ++i) {
        const double turn = 0.5 * i;
        values.push_back(i < with_one_map
                             ? shadow_value(i, "toMap",
                                            {0, 0, 0.1 * std::cos(turn), 0, 0, 0, 0.1 * std::sin(turn), 0,  //
                                             0, 0, 0.02, 0, 0.5, 0.5, 0.6, 1})
                             : shadow_value(i, "toMap", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}));
        values.push_back(shadow_value(i, "layer", {0}));
        values.push_back(shadow_value(i, "depthScale", {1.1}));
        values.push_back(
            shadow_value(i, "depthShift", {-0.6 * (0.6 + 0.1 * i)}));  // darker from 0.6 + 0.1 i on
        values.push_back(shadow_value(i, "spread", {0.5}));
    }
    return values;
}

double largest_of(const Image& image) {
    double largest = 0;
    for (const float value : image.values) largest = std::max(largest, static_cast<double>(std::abs(value)));
    return largest;
}

class Uber : public testing::TestWithParam<UberLights> {};

/// Both add the same terms in the same order; only what a compiler contracts or reorders may differ. 1e-6 is
/// eight roundings of the brightest radiance.
TEST_P(Uber, DrawsWhatEachPermutationDraws) {
    const ShippedFamily lit("lit");
    const ShippedFamily uber("uber");
    const Stage stage = make_stage();
    const std::vector<Key> keys = switched_cover(lit, uber);
    EXPECT_GT(keys.size(), 50U);
    std::vector<Key> uber_keys;
    for (const Key& key : keys) uber_keys.push_back(uber_key(uber.family, lit.family, key, GetParam()));
    Painter specialised(lit, stage, keys);
    Painter switched(uber, stage, uber_keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        SCOPED_TRACE(key_text(lit.family, keys[i]));
        const std::vector<RenderValue> values = with_shadows(lit.family, keys[i]);
        const Image expected = specialised.paint(i, values);
        const Image actual = switched.paint(i, uber_values(uber.family, lit.family, keys[i], values));
        const auto difference = compare(actual, expected);
        ASSERT_TRUE(difference);
        EXPECT_LE(difference->largest, 1e-6 * std::max(1.0, largest_of(expected))) << to_text(*difference);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, Uber, testing::Values(UberLights::switched, UberLights::looped),
                         [](const auto& row) {
                             return row.param == UberLights::switched ? "switched" : "looped";
                         });

TEST(UberKey, KeepsQualityAndSwitchesTheRest) {
    const ShippedFamily lit("lit");
    const ShippedFamily uber("uber");
    const Key key = *parse_key(lit.family, "fog=linear fog_distance=planar specular=phong point=2");
    EXPECT_EQ(
        key_text(uber.family, uber_key(uber.family, lit.family, key, UberLights::switched)),
        "ambient=switched cutout=switched diffuse=switched directional=1 directional_shadows=1 fog=switched "
        "fog_distance=planar light_ambient=switched lighting=switched material=switched "
        "reflection=switched sides=switched specular=switched spot=1 vertex_color=switched");
    EXPECT_EQ(lights_of(lit.family, key), 2);
}

}  // namespace
}  // namespace gobo::scene
