// From draws to keys, buckets and the funnel, over a family small enough to count by hand.
#include "scene/scene_keys.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "scene/read_scene.hpp"
#include "scene_support.hpp"

namespace gobo::scene {
namespace {

constexpr std::string_view family_text = R"(
name = "small"
vertex = "small.vert"
fragment = "small.frag"
[features.point]
role = "effect"
count = [0, 3]
constant = "POINT_LIGHTS"
[features.specular]
role = "effect"
values = ["none", "phong", "blinn"]
[features.fog]
role = "effect"
values = ["none", "linear"]
[[rules]]
when = "point == 0"
default = ["specular"]
)";

Family small_family() {
    Result<Family> family = read_family(family_text, "small.toml");
    EXPECT_TRUE(family) << to_text(family.error().front());
    return family ? std::move(*family) : Family();
}

Effect in(const std::string& feature, const std::string& value = "") {
    return {feature, feature, value, true, "in"};
}

Draw draw(const std::string& name, std::vector<Effect> effects) {
    return {0, 0, name, "", {}, std::move(effects)};
}

std::vector<Effect> points(int count, std::vector<Effect> others = {}) {
    for (int i = 0; i < count; ++i) others.push_back(in("point"));
    return others;
}

struct Keyed {
    std::string name;
    std::vector<Effect> effects;
    Buckets buckets;
    std::string key;
    std::vector<std::string> missing;
};

class DrawKeys : public testing::TestWithParam<Keyed> {};

TEST_P(DrawKeys, FollowFromEffects) {
    const Family family = small_family();
    const auto keys = keys_for_draws(family, {draw("draw", GetParam().effects)}, GetParam().buckets, "450");
    ASSERT_TRUE(keys) << to_text(keys.error().front());
    ASSERT_TRUE(keys->front());
    EXPECT_EQ(key_text(family, keys->front()->key), GetParam().key);
    EXPECT_EQ(keys->front()->missing, GetParam().missing);
}

INSTANTIATE_TEST_SUITE_P(
    Scene, DrawKeys,
    testing::Values(
        Keyed{"nothing", {}, {}, "default", {}}, Keyed{"two_points", points(2), {}, "point=2", {}},
        Keyed{"out_is_out", {{"point 0", "point", "", false, "dark"}}, {}, "default", {}},
        Keyed{"canonical", {in("specular", "blinn")}, {}, "default", {}},
        Keyed{"fog_and_highlight",
              points(1, {in("specular", "blinn"), in("fog", "linear")}),
              {},
              "fog=linear point=1 specular=blinn",
              {}},
        Keyed{"unknown_feature",
              {in("sides", "two")},
              {},
              "default",
              {"sides: needed, but not yet in the family"}},
        Keyed{"unknown_value",
              {in("fog", "layered")},
              {},
              "default",
              {"fog: layered is needed, but not yet in the family"}},
        Keyed{"too_many_points", points(4), {}, "point=3", {"point: needed, but beyond the 3 of the family"}},
        Keyed{"rounded_up", points(1), {0, 2}, "point=2", {}}, Keyed{"zero_stays", {}, {0, 2}, "default", {}},
        Keyed{"above_the_buckets", points(3), {0, 2}, "point=3", {}},
        Keyed{"bucket_beyond_the_family", points(1), {0, 8}, "point=3", {}}),
    [](const auto& row) { return row.param.name; });

TEST(SceneFunnel, CountsFromTheFamilyDownToTheScene) {
    const Family family = small_family();
    std::vector<Draw> draws = {draw("a", points(1)), draw("b", points(2)), draw("c", points(2)),
                               draw("d", {})};
    draws.push_back({0, 0, "lines", "its primitives are lines", {}, {}});
    const auto funnel =
        measure_funnel(family, keys_for_draws(family, draws, {}, "450").value(), {0, 2}, "450");
    ASSERT_TRUE(funnel);
    EXPECT_EQ(funnel->full_product, 24U) << "4 counts, 3 highlights, 2 fogs";
    EXPECT_EQ(funnel->valid, 20U) << "without lights, 2 of 3 highlights times 2 fogs are not canonical";
    EXPECT_EQ(funnel->draws, 4U) << "lines are not drawn";
    EXPECT_EQ(funnel->needed, 3U) << "0, 1 and 2 points";
    EXPECT_EQ(funnel->bucketed, 2U) << "0 and 2 points";
}

TEST(SceneFunnel, BucketingsTradePermutationsForUnusedLights) {
    const Family family = small_family();
    const auto rows = compare_bucketings(
        family,
        keys_for_draws(family, {draw("a", points(1)), draw("b", points(2)), draw("c", {})}, {}, "450")
            .value(),
        {0, 3}, "450");
    ASSERT_TRUE(rows);
    std::string table;
    for (const BucketingRow& row : *rows) {
        table += buckets_text(row.buckets) + ": " + std::to_string(row.permutations) + " permutations, " +
                 std::to_string(row.shaded_lights) + " of " + std::to_string(row.lights) + " lights\n";
    }
    EXPECT_EQ(table,
              "every count: 3 permutations, 3 of 3 lights\n"
              "0,1,2,4,8: 3 permutations, 3 of 3 lights\n"
              "0,2,8: 2 permutations, 4 of 3 lights\n"
              "0,8: 2 permutations, 6 of 3 lights\n"
              "8: 1 permutations, 9 of 3 lights\n"
              "0,3: 2 permutations, 6 of 3 lights\n");
}

struct BadBuckets {
    std::string name;
    std::string text;
};

class RefusedBuckets : public testing::TestWithParam<BadBuckets> {};

TEST_P(RefusedBuckets, AreWrongUsage) {
    const auto buckets = parse_buckets(GetParam().text);
    ASSERT_FALSE(buckets);
    EXPECT_EQ(to_text(buckets.error().front()),
              "gobo: error: --bucket-lights: '" + GetParam().text +
                  "' is not a rising list of light counts\n  help: write it like "
                  "0,1,2,4,8\n");
    EXPECT_EQ(exit_status(buckets.error()), 2);
}

INSTANTIATE_TEST_SUITE_P(Scene, RefusedBuckets,
                         testing::Values(BadBuckets{"letters", "0,few"}, BadBuckets{"falling", "0,4,2"},
                                         BadBuckets{"negative", "-1,2"}, BadBuckets{"twice", "2,2"},
                                         BadBuckets{"huge", "99999999999"}),
                         [](const auto& row) { return row.param.name; });

TEST(SceneDemo, CallsForTwoPermutationsOfLit) {
    DiskFileSystem disk;
    const std::string root = GOBO_SOURCE_DIR;
    const auto text = disk.read(root + "/templates/lit.toml");
    ASSERT_TRUE(text);
    const auto family = read_family(*text, "lit.toml");
    ASSERT_TRUE(family);
    const auto scene = read_scene(disk, root + "/tests/assets/scenes/teapot.gltf");
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    const auto draws = required_effects(*scene, eye_of_cameras(*scene), {});
    const auto keys = keys_for_draws(*family, draws, {}, "450");
    ASSERT_TRUE(keys);
    ASSERT_EQ(keys->size(), 2U);
    EXPECT_EQ(key_text(*family, (*keys)[0]->key), "directional=1 fog=linear point=1 specular=blinn spot=1");
    EXPECT_EQ(key_text(*family, (*keys)[1]->key), "directional=1 fog=linear point=1 spot=1");
    EXPECT_TRUE((*keys)[0]->missing.empty());
}

TEST(KeysOfAScene, AreThoseOfItsDrawsAndKeepNothingOfTheirEffects) {
    const Family family = small_family();
    DiskFileSystem disk;
    const auto scene =
        read_scene(disk, std::string(GOBO_SOURCE_DIR) + "/examples/still_life/still_life.gltf");
    ASSERT_TRUE(scene) << to_text(scene.error().front());
    const EyePlace eye = eye_of_cameras(*scene);
    const auto draws = required_effects(*scene, eye, {});
    const auto expected = keys_for_draws(family, draws, {0, 2}, "450").value();
    const auto keys = keys_for_scene(family, SceneDraws(*scene, eye, {}), {0, 2}, "450").value();
    EXPECT_EQ(keys.notes, notes_on_scene(*scene, draws, expected));
    ASSERT_EQ(keys.keys.size(), expected.size());
    std::size_t missing = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(keys.keys[i].has_value(), expected[i].has_value());
        if (!expected[i]) continue;
        EXPECT_EQ(keys.keys[i]->key, expected[i]->key) << expected[i]->name;
        EXPECT_EQ(missing_effects(family, draws[i]), expected[i]->missing);
        EXPECT_EQ(keys.keys[i]->missing.capacity(), 0U) << "of all draws: as many as draws times lights";
        missing += expected[i]->missing.size();
    }
    EXPECT_GT(missing, 0U);
}

TEST(NotesOnAScene, SayOnceWhatIsNotDrawn) {
    const Family family = small_family();
    Scene scene = read_patched("[]");
    scene.path = "x.gltf";
    std::vector<Draw> draws = {draw("a", {in("sheen"), in("point")}),
                               draw("b", {in("sheen"), in("fog", "linear")}),
                               draw("c", {in("fog", "volumetric")}), draw("d", {}), draw("e", {})};
    draws[3].excluded = draws[4].excluded = "its primitives are lines";
    const auto keys = keys_for_draws(family, draws, {}, "450");
    ASSERT_TRUE(keys);
    using Notes = std::vector<std::string>;
    EXPECT_EQ(notes_on_scene(scene, draws, *keys),
              Notes{"x.gltf: not drawn: fog, sheen, 2 draws (its primitives are lines)"});
    EXPECT_EQ(notes_on_scene(scene, {draws[0]}, {std::nullopt}), Notes{});
    std::vector<Effect> many = points(3);
    for (const int i : {2, 9, 10, 11, 12, 30, 100})
        many.push_back({fmt::format("point {}", i), "point", "", true, "in"});
    const std::vector<Draw> lit = {draw("a", many)};
    EXPECT_EQ(notes_on_scene(scene, lit, *keys_for_draws(family, lit, {}, "450")),
              Notes{"x.gltf: not drawn: point 2, point 9 to 12, point 30, point 100"});
}

}  // namespace
}  // namespace gobo::scene
