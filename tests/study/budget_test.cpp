// What a budget buys, of studies written down here.
#include <algorithm>

#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/study/qualities.hpp"
#include "lab/study/study.hpp"

namespace gobo::study {
namespace {

Family small_family() {
    return read_family(R"(
name = "small"
vertex = "small.vert"
fragment = "small.frag"
[features.light]
count = [0, 2]
constant = "LIGHTS"
[features.power]
role = "quality"
values = ["exact", "rough", "wild"]
[features.shading]
role = "quality"
values = ["fragment", "vertex"]
[[rules]]
when = "light == 0"
default = ["power", "shading"]
[[rules]]
forbid = "power == wild && shading == vertex"
reason = "too wild"
)",
                       "small.toml")
        .value();
}

Key key_of(const std::string& text) {
    return parse_key(small_family(), text).value();
}

std::vector<StudiedKey> studied() {
    return {{key_of("light=1"), 1e-6, 100, true},
            {key_of("light=1 power=rough"), 1e-3, 60, true},
            {key_of("light=1 shading=vertex"), 0.2, 20, true},
            {key_of("light=1 power=rough shading=vertex"), 0.3, 15, true}};
}

struct BudgetRow {
    const char* name;
    Budget budget;
    const char* key;  ///< nullptr: refused
    const char* help;
};

class Buys : public testing::TestWithParam<BudgetRow> {};

TEST_P(Buys, TheBestWithinIt) {
    const auto chosen = choose(studied(), GetParam().budget, "light=1");
    ASSERT_EQ(chosen.has_value(), GetParam().key != nullptr);
    if (chosen)
        EXPECT_EQ(key_text(small_family(), chosen->key), GetParam().key);
    else
        EXPECT_EQ(chosen.error().front().help, GetParam().help);
}

// The typical error is kSafety = 2 times the measured error.
INSTANTIATE_TEST_SUITE_P(
    Rows, Buys,
    testing::Values(
        BudgetRow{"the_cheapest_within_the_error", {.max_error = 0.5}, "light=1 shading=vertex", ""},
        BudgetRow{
            "an_error_that_the_typical_one_just_meets", {.max_error = 0.002}, "light=1 power=rough", ""},
        BudgetRow{"an_error_that_the_measurement_alone_would_meet", {.max_error = 0.0015}, "light=1", ""},
        BudgetRow{"the_most_accurate_within_the_cost", {.max_cost = 70}, "light=1 power=rough", ""},
        BudgetRow{"both",
                  {.max_error = 0.5, .max_cost = 18},
                  nullptr,
                  "raise the budget: the most accurate one may err by 2.0e-06"},
        BudgetRow{"an_error_too_small",
                  {.max_error = 1e-7},
                  nullptr,
                  "raise the budget: the most accurate one may err by 2.0e-06"},
        BudgetRow{
            "a_cost_too_small", {.max_cost = 10}, nullptr, "raise the budget: the cheapest one costs 15"}),
    [](const auto& row) { return row.param.name; });

TEST(Studied, IsReadFromTheRowsOfAllScenes) {
    const auto read = read_studied(
        "effects,key,scene,error_max,cost,front\n"
        "light=1,light=1,*,1e-6,100,yes\nlight=1,light=1,teapot,1e-7,90,yes\n"
        "light=1,light=1 power=rough,*,inf,60,no\n",
        "study.csv", small_family());
    ASSERT_TRUE(read);
    const auto& keys = read->at(key_of("light=1"));
    ASSERT_EQ(keys.size(), 2u);
    EXPECT_EQ(keys[0].error, 1e-6);
    EXPECT_EQ(keys[0].cost, 100);
    EXPECT_TRUE(keys[0].on_front);
    EXPECT_EQ(keys[1].key, key_of("light=1 power=rough"));
    EXPECT_FALSE(keys[1].on_front);
}

TEST(Studied, SaysWhatIsPromised) {
    const auto read = read_studied(
        "effects,key,scene,error_max,cost,front,error_worst\n"
        "light=1,light=1,*,1e-6,100,yes,0\nlight=1,light=1 power=rough,*,1e-3,60,yes,0.2\n"
        "light=1,light=1 shading=vertex,*,0.2,20,yes,none\nlight=1,light=1 power=wild,*,0.3,10,yes,\n"
        "light=1,light=1 power=rough,*,1e-3,60,yes,0.8\n",
        "study.csv", small_family());
    ASSERT_TRUE(read);
    const auto& keys = read->at(key_of("light=1"));
    EXPECT_EQ(promised_error(keys[0]), 2e-6) << "at least what is typical";
    EXPECT_EQ(promised_error(keys[1]), kDomainSafety * 0.2);
    EXPECT_FALSE(promised_error(keys[2])) << "it hangs on the mesh";
    EXPECT_TRUE(keys[2].worst) << "and that is known";
    EXPECT_FALSE(keys[3].worst) << "it was not searched";
    EXPECT_FALSE(promised_error(keys[4])) << "all of the light";
}

TEST(Studied, OfAnotherFamilyIsRefusedAtItsLine) {
    const auto read =
        read_studied("effects,key,scene,error_max,cost,front\nfog=linear,fog=linear,*,1,1,yes\n", "study.csv",
                     small_family());
    ASSERT_FALSE(read);
    EXPECT_EQ(to_text(read.error().front()).substr(0, 12), "study.csv:2:");
    EXPECT_EQ(read.error().front().help, "remake the study: gobo study small -o FOLDER");
}

TEST(FrontQualities, AreAppliedToOtherEffects) {
    const StudiedEffects all = {{key_of("light=1"), studied()}};
    const auto keys = front_qualities(small_family(), all, key_of("light=2"));
    std::vector<std::string> texts;
    for (const Key& key : keys) texts.push_back(key_text(small_family(), key));
    EXPECT_EQ(texts, (std::vector<std::string>{"light=2", "light=2 power=rough", "light=2 shading=vertex",
                                               "light=2 power=rough shading=vertex"}));
    EXPECT_EQ(front_qualities(small_family(), all, key_of("default")), std::vector<Key>{key_of("default")})
        << "where nothing matters there is one quality";
}

TEST(Qualities, AreAllThatTheRulesAllow) {
    const Family family = small_family();
    EXPECT_EQ(all_qualities(family, key_of("light=1"), 100).size(), 5u) << "six without the forbidden one";
    EXPECT_EQ(all_qualities(family, key_of("default"), 100).size(), 1u);
    EXPECT_TRUE(all_qualities(family, key_of("light=1"), 3).empty()) << "more than asked for";
    std::vector<std::string> singles;
    for (const Choice& choice : single_choices(family, key_of("light=1 power=rough")))
        singles.push_back(quality_text(family, choice.key));
    EXPECT_EQ(singles, (std::vector<std::string>{"power=rough", "power=wild", "shading=vertex"}));
}

TEST(Qualities, HoldTheMostAccurateEvenWhereItIsExcluded) {
    Family family = small_family();
    family.features[*family.index_of("power")].excluded = {"exact"};
    const std::vector<Key> keys = all_qualities(family, key_of("light=1"), 100);
    EXPECT_EQ(std::ranges::count(keys, most_accurate(family, key_of("light=1"))), 1);
}

}  // namespace
}  // namespace gobo::study
