// Keys as text, conditions, and which keys a selection means.
#include "family/selection.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(const Family& family, const Selection& selection, std::string_view dialect) {
    std::vector<std::string> found;
    const std::vector<Key> keys = select(family, selection, dialect).value();
    for (const Key& key : keys) found.push_back(key_text(family, key));
    return found;
}

TEST(Key, TextReadsBackForEveryKeyInAnyOrder) {
    std::mt19937 random(1);
    for (const auto& [name, body] : small_families()) {
        const Family family = family_of(body);
        for (const Key& key : product_of(family)) {
            const std::string text = key_text(family, key);
            ASSERT_EQ(parse_key(family, text), key) << name << ": " << text;
            std::vector<std::string> words;
            for (std::size_t i = 0; i < key.size(); ++i)
                words.push_back(family.features[i].name + "=" +
                                family.features[i].values[static_cast<std::size_t>(key[i])]);
            std::shuffle(words.begin(), words.end(), random);
            std::string shuffled = " \t";
            for (const std::string& word : words) shuffled += word + "  ";
            ASSERT_EQ(parse_key(family, shuffled), key) << name << ": " << shuffled;
        }
    }
}

TEST(Key, CanonicalIsAFixpointThatKeepsWhatMatters) {
    for (const auto& [name, body] : small_families()) {
        const Family family = family_of(body);
        for (const Key& key : product_of(family)) {
            const Key once = canonical(family, key, "450");
            ASSERT_EQ(canonical(family, once, "450"), once) << name;
            for (std::size_t i = 0; i < key.size(); ++i)
                ASSERT_TRUE(once[i] == key[i] || once[i] == 0) << name << ": only defaults may come in";
        }
    }
}

TEST(Key, OfLitIsTakenToItsCanonicalForm) {
    const Family lit = lit_family();
    const std::pair<const char*, const char*> rows[] = {
        {"", "default"},
        {"default", "default"},
        {"point=3 fog=linear", "fog=linear point=3"},
        {"fog=none fog_distance=planar", "default"},
        {"shading=vertex specular=phong diffuse=toon", "default"},
        {"specular=phong diffuse=toon spot=1", "diffuse=toon spot=1"},
    };
    for (const auto& [text, expected] : rows) {
        const Key key = canonical(lit, parse_key(lit, text).value(), "450");
        EXPECT_EQ(key_text(lit, key), expected) << text;
    }
}

struct ConditionRow {
    const char* name;
    const char* text;
    bool (*meaning)(int a, int b, int s);
};

class Condition : public testing::TestWithParam<ConditionRow> {};

TEST_P(Condition, HoldsWhereItSays) {
    const Family family = family_of(small_families()[4].second);  // counts a, b, c and the choice s
    const Expression expression =
        parse_expression(GetParam().text, family.features, {}, Fault::usage).value();
    for (const Key& key : product_of(family))
        ASSERT_EQ(holds(expression, key), GetParam().meaning(key[0], key[1], key[3]))
            << key_text(family, key);
}

INSTANTIATE_TEST_SUITE_P(
    Grammar, Condition,
    testing::Values(ConditionRow{"equal", "a == 2", [](int a, int, int) { return a == 2; }},
                    ConditionRow{"not_equal", "s != y", [](int, int, int s) { return s != 1; }},
                    ConditionRow{"order", "a<=1||b>=3", [](int a, int b, int) { return a <= 1 || b >= 3; }},
                    ConditionRow{"strict", "a<1 || b>3", [](int a, int b, int) { return a < 1 || b > 3; }},
                    ConditionRow{"sum", "a + b > 5", [](int a, int b, int) { return a + b > 5; }},
                    ConditionRow{"sum_twice", "a + a == 4", [](int a, int, int) { return a == 2; }},
                    ConditionRow{"and_binds_tighter", "a == 0 || a == 1 && b == 1",
                                 [](int a, int b, int) { return a == 0 || (a == 1 && b == 1); }},
                    ConditionRow{"parentheses", "(a == 0 || a == 1) && b == 1",
                                 [](int a, int b, int) { return a <= 1 && b == 1; }},
                    ConditionRow{"not_binds_tightest", "!a == 0 && b == 1",
                                 [](int a, int b, int) { return a != 0 && b == 1; }},
                    ConditionRow{"not_of_parentheses", "!(s == x || a > 2)",
                                 [](int a, int, int s) { return s != 0 && a <= 2; }},
                    ConditionRow{"not_not", "!!(b == 4)", [](int, int b, int) { return b == 4; }}),
    [](const auto& row) { return row.param.name; });

TEST(Condition, NestedTooDeeplyIsRefused) {
    const Family family = family_of(small_families()[4].second);
    const std::string deep = std::string(100000, '(') + "a == 1" + std::string(100000, ')');
    const auto refused = parse_expression(deep, family.features, {}, Fault::usage);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().front().message.starts_with("the condition is nested too deeply"));
}

const char* const two_features =
    "[features]\na = { count = [0, 2], constant = \"A\" }\ns = { values = [\"x\", \"y\"] }\n"
    "[[rules]]\nwhen = \"a == 0\"\ndefault = [\"s\"]\n"
    "[[rules]]\nforbid = \"a == 2 && s == y\"\nreason = \"never\"\n";

TEST(Selection, UnitesItsPartsSortedAndOnce) {
    const Family family = family_of(two_features);
    Selection selection;
    selection.keys = {{"s=y a=1", {}}, {"s=y", {}}, {"a=1 s=y", {}}};
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("default", "a=1 s=y"));
    selection.all = true;
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("default", "a=1", "a=1 s=y", "a=2"));
}

TEST(Selection, WhereRestrictsSpacesAndFiltersNamedKeys) {
    const Family family = family_of(two_features);
    Selection selection;
    selection.keys = {{"a=1 s=y", {}}, {"a=2", {}}};
    selection.where = "s == x";
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("a=2"));
    selection.keys.clear();
    selection.cover = 2;
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("default", "a=1", "a=2"));
}

TEST(Selection, OverLeavesTheOthersAtTheirDefaults) {
    const Family family = family_of(two_features);
    Selection selection;
    selection.all = true;
    selection.over = {"a"};
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("default", "a=1", "a=2"));
    selection.over = {"s"};
    EXPECT_THAT(texts(family, selection, "450"), ElementsAre("default"));
}

TEST(Selection, OfNothingIsTheFamilysDefaultSet) {
    EXPECT_THAT(texts(family_of(two_features), {}, "450"), ElementsAre("default", "a=1", "a=1 s=y", "a=2"))
        << "a small family: all";
    const std::string declared =
        std::string(two_features) + "[default_set]\nkeys = [\"a=2\"]\nwhere = \"a > 1\"\n";
    EXPECT_THAT(texts(family_of(declared), {}, "450"), ElementsAre("a=2"));
    Selection filtered;
    filtered.where = "a < 2";
    EXPECT_THAT(texts(family_of(declared), filtered, "450"), ElementsAre()) << "both conditions hold";
}

TEST(Selection, ExcludedValuesAreOnlyNamed) {
    const auto& families = small_families();
    const auto excluded = std::find_if(families.begin(), families.end(),
                                       [](const auto& row) { return row.first == "dialects_and_excluded"; });
    ASSERT_NE(excluded, families.end());
    const Family family = family_of(excluded->second);
    Selection selection;
    selection.all = true;
    EXPECT_THAT(texts(family, selection, "330"), ElementsAre("default", "b=on", "a=y"));
    selection.keys = {{"a=z", {}}};
    EXPECT_THAT(texts(family, selection, "330"), ElementsAre("default", "b=on", "a=y", "a=z"));
    selection.excluded = true;
    EXPECT_EQ(texts(family, selection, "450").size(), 6u);
}

/// A family of which a feature and values of it and of another have other names than before.
const char* const renamed_family =
    "[features.edge]\nvalues = [\"one_minus_cosine\", \"cosine\"]\n"
    "[features.evaluation]\nvalues = [\"fragment\", \"vertex\"]\n"
    "[features.point]\ncount = [0, 2]\nconstant = \"POINT\"\n"
    "[renamed]\nintensity = \"evaluation\"\n\"edge=versine\" = \"edge=one_minus_cosine\"\n"
    "\"intensity=corner\" = \"evaluation=vertex\"\n";

TEST(Selection, OldNamesAreRefusedWithTheNewOnes) {
    const Family family = family_of(renamed_family);
    const auto refusal = [&](const std::string& key, const std::string& over, const std::string& where) {
        Selection selection;
        if (!key.empty()) selection.keys = {{key, {}}};
        selection.all = key.empty();
        if (!over.empty()) selection.over = {over};
        selection.where = where;
        const Result<std::vector<Key>> keys = select(family, selection, "450");
        return keys ? "" : first_text(keys.error());
    };
    EXPECT_EQ(
        refusal("edge=versine", "", ""),
        "gobo: error: feature 'edge' has no value 'versine'\n  help: 'versine' is now 'one_minus_cosine'\n");
    EXPECT_EQ(
        refusal("intensity=vertex", "", ""),
        "gobo: error: family 'tiny' has no feature 'intensity'\n  help: 'intensity' is now 'evaluation'\n");
    EXPECT_EQ(refusal("evaluation=corner", "", ""),
              "gobo: error: feature 'evaluation' has no value 'corner'\n  help: 'corner' is now 'vertex'\n");
    EXPECT_EQ(refusal("point=3", "", ""),
              "gobo: error: feature 'point' has no value '3'\n  help: a whole number from 0 to 2\n");
    EXPECT_EQ(refusal("", "intensity", ""),
              "gobo: error: --over: family 'tiny' has no feature 'intensity'\n  help: 'intensity' is now "
              "'evaluation'\n");
    EXPECT_EQ(refusal("", "", "intensity == vertex"),
              "gobo: error: unknown feature 'intensity' in the condition 'intensity == vertex'\n"
              "  help: 'intensity' is now 'evaluation'\n");
    EXPECT_EQ(refusal("", "", "edge != versine"),
              "gobo: error: feature 'edge' has no value 'versine' in the condition 'edge != versine'\n"
              "  help: 'versine' is now 'one_minus_cosine'\n");
}

TEST(Selection, CountsWhatItSelects) {
    for (const auto& [name, body] : small_families()) {
        const Family family = family_of(body);
        Selection all;
        all.all = true;
        EXPECT_EQ(count_selected(family, all, "450"), select(family, all, "450").value().size()) << name;
        EXPECT_EQ(count_selected(family, {}, "450"), select(family, {}, "450").value().size()) << name;
    }
}

TEST(Selection, ReadsKeysByLines) {
    const std::vector<NamedKey> keys =
        keys_of_text("# comment\r\n\r\n a=1 \r\ndefault # the plain one\n\n\ta=2", "keys.txt");
    ASSERT_EQ(keys.size(), 3u);
    EXPECT_EQ(keys[0].text, "a=1");
    EXPECT_EQ(keys[0].place, (Place{"keys.txt", 3, 0}));
    EXPECT_EQ(keys[1].text, "default");
    EXPECT_EQ(keys[2].place.line, 6);
    const std::vector<NamedKey> old = keys_of_text("a=1\r\rdefault # plain\r", "keys.txt");
    ASSERT_EQ(old.size(), 2u);
    EXPECT_EQ(old[0].text, "a=1");
    EXPECT_EQ(old[1].text, "default");
    EXPECT_EQ(old[1].place.line, 3);
}

}  // namespace
}  // namespace gobo
