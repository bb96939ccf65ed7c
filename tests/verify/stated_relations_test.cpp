// Relations that a family states: each holds of shaders of which it is true, and finds one of which it is
// not.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "lab/verify/verify.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// Lamps in a space of their own, seen through a mist. `lampLight` is of vec3 p, n and Lamp l.
struct Shaders {
    std::string lamp = "l.color * max(dot(n, normalize(l.at - p)), 0.0)";
    std::string sum = "for (int i = 0; i < LAMPS; ++i) light += lampLight(lamps.lamps[i], p, n);";
    std::string mist = "mix(vec3(0.5), light, exp(-mist.density * length(p)))";
};

const char* const vertex = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 p;
layout(location = 1) out vec3 n;
layout(std140, binding = 0) uniform Places { mat4 toSpace; mat3 turn; mat4 toClip; } places;
void main() {
    p = vec3(places.toSpace * vec4(position, 1.0));
    n = places.turn * normal;
    gl_Position = places.toClip * vec4(p, 1.0);
}
)";

std::string fragment(const Shaders& shaders) {
    return R"(#version 450
layout(location = 0) in vec3 p;
layout(location = 1) in vec3 n;
layout(location = 0) out vec4 color;
#if LAMPS > 0
struct Lamp { vec3 at; vec3 color; };
layout(std140, binding = 1) uniform Lamps { Lamp lamps[LAMPS]; } lamps;
vec3 lampLight(Lamp l, vec3 p, vec3 n) { return )" +
           shaders.lamp + R"(; }
#endif
#ifdef MIST
layout(std140, binding = 2) uniform Mist { float density; } mist;
#endif
void main() {
    vec3 light = vec3(0.1);
#if LAMPS > 0
    )" + shaders.sum +
           R"(
#endif
#ifdef MIST
    light = )" +
           shaders.mist + R"(;
#endif
    color = vec4(light, 1.0);
}
)";
}

const std::string features = R"(
name = 'lamps'
vertex = 'lamps.vert'
fragment = 'lamps.frag'
[features.lamp]
count = [0, 3]
constant = 'LAMPS'
[features.mist]
define = 'MIST'
[domain]
'Mist.density' = [0, 1]
'Lamps.lamps[].color' = [0, 2]
)";

/// The relations tried on a key of a family of these shaders.
verify::PermutationReport try_on(const std::string& key, const std::string& relation,
                                 const Shaders& shaders) {
    const MemoryFileSystem files({{"lamps/lamps.vert", vertex}, {"lamps/lamps.frag", fragment(shaders)}});
    const Family family = read_family(features + "[[relations]]\n" + relation, "lamps/lamps.toml").value();
    SearchPath search;
    search.add(files, "lamps", "", false);
    std::vector<Key> keys = {parse_key(family, key).value()};
    const std::vector<Key> partners = verify::partners(family, keys, "450");
    keys.insert(keys.end(), partners.begin(), partners.end());
    const Composition composition = compose(family, keys, search, Dialect::own).value();
    ValidateOptions validate_options;
    validate_options.keep_spirv = true;
    verify::VerifyOptions options;
    options.partners = partners.size();
    const verify::VerifyReport report =
        verify::verify(family, composition, validate(family, composition, validate_options), options);
    EXPECT_EQ(report.permutations.size(), 1U) << "partners are not reported";
    EXPECT_TRUE(report.permutations[0].diagnostics.empty());
    return report.permutations[0];
}

const std::string any_order = "any_order = 'Lamps.lamps'";
const std::string adds = "adds = 'Lamps.lamps[].color'";
const std::string turn =
    "turn = ['Places.toSpace', 'Places.turn', 'Lamps.lamps[].at']\nturn_back = ['Places.toClip']";
const std::string lamp_off = "off = 'lamp'\nat = { 'Lamps.lamps[].color' = 0 }";
const std::string mist_off = "off = 'mist'\nat = { 'Mist.density' = 0 }";

struct Row {
    std::string name;
    std::string key;
    std::string relation;
    Shaders wrong;
};

class StatedRelation : public ::testing::TestWithParam<Row> {};

TEST_P(StatedRelation, HoldsAndFindsWhatIsWrong) {
    const Row& row = GetParam();
    const verify::PermutationReport right = try_on(row.key, row.relation, {});
    ASSERT_EQ(right.relations.size(), 1U) << "the relation was tried";
    EXPECT_EQ(right.relations[0].points, 64U);
    EXPECT_EQ(right.relations[0].failed, 0U) << right.relations[0].found;
    const verify::PermutationReport wrong = try_on(row.key, row.relation, row.wrong);
    ASSERT_EQ(wrong.relations.size(), 1U);
    EXPECT_GT(wrong.relations[0].failed, 8U);
    ASSERT_TRUE(wrong.relations[0].worst.has_value());
    EXPECT_EQ(wrong.failed_points, 0U) << "single and double precision agree on what is wrong";
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, StatedRelation,
    ::testing::Values(
        Row{"order_forgets_one",
            "lamp=3",
            any_order,
            {.sum = "for (int i = 0; i < LAMPS - 1; ++i) light += lampLight(lamps.lamps[i], p, n);"}},
        Row{"order_counts_one_twice",
            "lamp=2",
            any_order,
            {.sum = "for (int i = 0; i < LAMPS; ++i) light += lampLight(lamps.lamps[i / 2], p, n);"}},
        Row{"adds_a_square",
            "lamp=2",
            adds,
            {.lamp = "l.color * l.color * max(dot(n, normalize(l.at - p)), 0.0)"}},
        Row{"adds_something_without_color",
            "lamp=1",
            adds,
            {.lamp = "(l.color + 0.1) * max(dot(n, normalize(l.at - p)), 0.0)"}},
        Row{"turn_with_a_direction_of_the_space",
            "lamp=2",
            turn,
            {.lamp = "l.color * max(dot(n, normalize(l.at - p)), 0.0) * abs(p.z)"}},
        Row{"off_lamp_adds_ambient_light",
            "lamp=2",
            lamp_off,
            {.lamp = "l.color * max(dot(n, normalize(l.at - p)), 0.0) + 0.01"}},
        Row{"off_mist_that_never_clears",
            "lamp=1 mist=on",
            mist_off,
            {.mist = "mix(vec3(0.5), light, exp(-(mist.density + 0.1) * length(p)))"}}),
    [](const auto& row) { return row.param.name; });

TEST(StatedRelations, SpeakOnlyOfTheKeysThatHaveWhatTheyNeed) {
    EXPECT_TRUE(try_on("lamp=1", any_order, {}).relations.empty()) << "one lamp has no order";
    EXPECT_TRUE(try_on("default", adds, {}).relations.empty()) << "no lamps";
    EXPECT_TRUE(try_on("lamp=1", mist_off, {}).relations.empty()) << "no mist to turn off";
    EXPECT_TRUE(try_on("lamp=2", any_order + "\nwhen = 'lamp == 3'", {}).relations.empty());
    EXPECT_EQ(try_on("lamp=3", any_order + "\nwhen = 'lamp == 3'", {}).relations.size(), 1U);
}

/// The keys of a cover, and what they are compared with: more than `gobo test lit` composes.
TEST(StatedRelations, ThoseOfLitHold) {
    const Family family = lit_family();
    Selection selection;
    selection.cover = 2;
    selection.where = "directional <= 2 && point <= 2 && spot <= 2";
    // In so small a cover lights without shadows and without ambient light of their own may not meet.
    selection.keys = {
        {"directional=2 directional_or_point=2 fog=exponential point=2 specular=blinn spot=2", {}}};
    std::vector<Key> keys = select(family, selection, "450").value();
    const std::size_t tested = keys.size();
    for (std::size_t i = 0; i < tested; ++i)
        for (const Relation& relation : family.relations)
            if (auto partner = verify::partner_of(family, relation, keys[i], "450"))
                if (std::find(keys.begin(), keys.end(), *partner) == keys.end()) keys.push_back(*partner);
    verify::VerifyOptions options;
    options.vertices = options.fragments = 1;
    options.partners = keys.size() - tested;
    const auto report = verify_lit(family, keys, {}, options);
    ASSERT_TRUE(report) << to_text(report.error().front());
    std::set<std::size_t> tried;
    for (const verify::PermutationReport& permutation : report->permutations)
        for (const verify::RelationReport& relation : permutation.relations) {
            tried.insert(relation.relation);
            EXPECT_EQ(relation.failed, 0U)
                << key_text(family, permutation.key) << ": " << family.relations[relation.relation].text
                << ": " << relation.found;
        }
    EXPECT_EQ(tried.size(), family.relations.size()) << "each finds a key of which it speaks";
}

}  // namespace
}  // namespace gobo
