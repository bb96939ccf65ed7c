// The decision diagram against brute force, and covers against their definition.
#include "family/key_space.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "family/cover.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

KeySpace space_of(const Family& family, std::string_view dialect = "450", const KeySpaceLimits& limits = {}) {
    return KeySpace::make(family, dialect, limits).value();
}

Expression condition(const Family& family, const std::string& text) {
    return parse_expression(text, family.features, {}, Fault::usage).value();
}

/// Every way of leaving features of a key open, over all keys of the product: 2^n per key.
std::vector<PartialKey> partial_keys(const Family& family) {
    std::set<PartialKey> partial;
    for (const Key& key : product_of(family)) {
        for (unsigned open = 0; open < (1u << key.size()); ++open) {
            PartialKey some = key;
            for (std::size_t i = 0; i < key.size(); ++i) some[i] = (open >> i & 1u) != 0 ? -1 : some[i];
            partial.insert(some);
        }
    }
    return {partial.begin(), partial.end()};
}

bool agrees(const PartialKey& partial, const Key& key) {
    for (std::size_t i = 0; i < key.size(); ++i) {
        if (partial[i] >= 0 && partial[i] != key[i]) return false;
    }
    return true;
}

class SmallFamily : public testing::TestWithParam<std::pair<std::string, std::string>> {
  protected:
    Family family = family_of(GetParam().second);
};

TEST_P(SmallFamily, CountsAndListsWhatTryingFinds) {
    for (const std::string_view dialect : {"450", "330"}) {
        for (const bool excluded : {false, true}) {
            KeySpaceLimits limits;
            limits.excluded = excluded;
            const KeySpace space = space_of(family, dialect, limits);
            const std::vector<Key> expected = keys_by_trying(family, dialect, limits);
            EXPECT_EQ(space.keys(), expected) << dialect;
            EXPECT_EQ(space.count(), expected.size()) << dialect;
        }
    }
}

TEST_P(SmallFamily, KeepsOtherFeaturesAtTheirDefaults) {
    for (int feature = 0; feature < static_cast<int>(family.features.size()); ++feature) {
        KeySpaceLimits limits;
        limits.over = {feature};
        EXPECT_EQ(space_of(family, "450", limits).keys(), keys_by_trying(family, "450", limits)) << feature;
    }
}

TEST_P(SmallFamily, ContainsExactlyWhatSomeKeyAgreesWith) {
    const KeySpace space = space_of(family);
    const std::vector<Key> keys = space.keys();
    for (const PartialKey& partial : partial_keys(family)) {
        const bool expected =
            std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return agrees(partial, key); });
        OpenPaths paths(space);
        bool is_contained = !keys.empty();
        for (std::size_t i = 0; i < partial.size() && is_contained; ++i) {
            if (partial[i] < 0) continue;
            is_contained = paths.allowed(i)[partial[i]] != 0;
            paths.decide(i, partial[i]);
        }
        ASSERT_EQ(is_contained, expected) << testing::PrintToString(partial);
    }
}

/// By the number of each combination of these features' values, whether some key holds it.
std::vector<bool> combinations(const Family& family, const std::vector<std::size_t>& features,
                               const std::vector<Key>& keys) {
    std::size_t count = 1;
    for (const std::size_t feature : features) count *= family.features[feature].values.size();
    std::vector<bool> found(count);
    for (const Key& key : keys) {
        std::size_t number = 0;
        for (const std::size_t feature : features)
            number = number * family.features[feature].values.size() + static_cast<std::size_t>(key[feature]);
        found[number] = true;
    }
    return found;
}

/// A cover holds every combination of `strength` values that some key of the space holds, and nothing else.
void expect_cover(const Family& family, const std::vector<Key>& keys, const std::vector<Key>& covering,
                  std::size_t strength) {
    std::vector<bool> is_chosen(family.features.size());
    std::fill_n(is_chosen.begin(), strength, true);
    do {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < is_chosen.size(); ++i)
            if (is_chosen[i]) chosen.push_back(i);
        ASSERT_EQ(combinations(family, chosen, covering), combinations(family, chosen, keys))
            << testing::PrintToString(chosen);
    } while (std::prev_permutation(is_chosen.begin(), is_chosen.end()));
    EXPECT_TRUE(std::includes(keys.begin(), keys.end(), covering.begin(), covering.end()));
    EXPECT_LE(covering.size(), keys.size());
}

TEST_P(SmallFamily, IsCovered) {
    const KeySpace space = space_of(family);
    for (int strength = 1; strength <= static_cast<int>(family.features.size()); ++strength) {
        SCOPED_TRACE(strength);
        expect_cover(family, space.keys(), cover(space, strength).value(),
                     static_cast<std::size_t>(strength));
        EXPECT_EQ(cover(space, strength).value(), cover(space_of(family), strength).value())
            << "not repeatable";
    }
}

INSTANTIATE_TEST_SUITE_P(Families, SmallFamily, testing::ValuesIn(small_families()),
                         [](const auto& row) { return row.param.first; });

struct LitRow {
    const char* name;
    const char* where;
};

class LitSpace : public testing::TestWithParam<LitRow> {};

TEST_P(LitSpace, IsWhatTryingFindsAndIsCoveredBySize) {
    const Family family = lit_family();
    KeySpaceLimits limits;
    limits.where = {condition(family, GetParam().where)};
    // All of lit's keys are too many to be tried.
    for (const char* feature :
         {"directional", "point", "spot", "diffuse", "specular", "fog", "fog_distance", "shading", "depth"})
        limits.over.push_back(family.index_of(feature).value());
    const KeySpace space = space_of(family, "450", limits);
    const std::vector<Key> expected = keys_by_trying(family, "450", limits);
    ASSERT_EQ(space.keys(), expected);
    EXPECT_EQ(space.count(), expected.size());
    for (const int strength : {2, 3}) {
        const std::vector<Key> covering = cover(space, strength).value();
        expect_cover(family, expected, covering, static_cast<std::size_t>(strength));
        RecordProperty("cover_" + std::to_string(strength),
                       std::to_string(covering.size()) + " of " + std::to_string(expected.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Conditions, LitSpace,
                         testing::Values(LitRow{"one_of_each", "point <= 1 && spot <= 1 && directional <= 1"},
                                         LitRow{"few_lights", "point + spot + directional <= 2"},
                                         LitRow{"toon_or_fog",
                                                "(diffuse == toon || fog == linear) && point + spot < 2 && "
                                                "directional == 0"}),
                         [](const auto& row) { return row.param.name; });

/// Families that a diagram whose levels follow the names of the features would drown in.
struct WideRow {
    const char* name;
    std::string body;
    std::uint64_t count;
};

std::string defines(int count) {
    std::string body = "[features]\n";
    for (int i = 0; i < count; ++i) body += fmt::format("f{0:02} = {{ define = \"F{0}\" }}\n", i);
    return body;
}

std::string counts(int count, int largest) {
    std::string body = "[features]\n";
    for (int i = 0; i < count; ++i)
        body += fmt::format("c{0:02} = {{ count = [0, {1}], constant = \"C{0}\" }}\n", i, largest);
    return body;
}

std::string forbid(const std::string& condition) {
    return fmt::format("[[rules]]\nforbid = \"{}\"\nreason = \"no\"\n", condition);
}

std::string pairs(int count) {
    std::string body = defines(2 * count);
    for (int i = 0; i < count; ++i)
        body += forbid(
            fmt::format("f{0:02} == on && f{1:02} == off || f{0:02} == off && f{1:02} == on", i, i + count));
    return body;
}

std::string one_rule_of_pairs(int count) {
    std::string condition;
    for (int i = 0; i < count; ++i)
        condition += fmt::format("{}(f{:02} == on || f{:02} == on)", i == 0 ? "" : " && ", i, i + count);
    return defines(2 * count) + forbid(condition);
}

std::string sum_of(int count) {
    std::string sum = "c00";
    for (int i = 1; i < count; ++i) sum += fmt::format(" + c{:02}", i);
    return sum;
}

std::uint64_t power(std::uint64_t base, int exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// The ways to choose a, b, c and d from 0 to `largest` with a + d == b + c.
std::uint64_t equal_sums(std::uint64_t largest) {
    std::uint64_t ways = 0;
    for (std::uint64_t sum = 0; sum <= 2 * largest; ++sum) {
        const std::uint64_t pairs = std::min(sum, 2 * largest - sum) + 1;
        ways += pairs * pairs;
    }
    return ways;
}

class WideFamily : public testing::TestWithParam<WideRow> {};

TEST_P(WideFamily, IsCounted) {
    EXPECT_EQ(space_of(family_of(GetParam().body)).count(), GetParam().count);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, WideFamily,
    testing::Values(WideRow{"eighteen_pairs", pairs(18), power(2, 18)},
                    WideRow{"thirty_pairs", pairs(30), power(2, 30)},
                    WideRow{"eighteen_pairs_in_one_rule", one_rule_of_pairs(18), power(4, 18) - power(3, 18)},
                    WideRow{"a_sum_at_its_largest", counts(40, 3) + forbid(sum_of(40) + " < 119"), 41},
                    // As many keys sum up to less than the middle as to more.
                    WideRow{"a_sum_of_seven", counts(7, 63) + forbid(sum_of(7) + " > 220"), power(64, 7) / 2},
                    WideRow{"sums_of_both_sides", counts(4, 100) + forbid("c00 + c03 != c01 + c02"),
                            equal_sums(100)}),
    [](const auto& row) { return row.param.name; });

TEST(KeySpace, NamesTheRuleThatTakesTooMuch) {
    const Family family =
        family_of(counts(10, 4096) + forbid("c00 == 1 && c01 == 1") + forbid(sum_of(10) + " > 20000"));
    const Result<KeySpace> space = KeySpace::make(family, "450", {});
    ASSERT_FALSE(space);
    EXPECT_EQ(
        first_text(space.error()),
        "tiny.toml:18:1: error: the conditions of family 'tiny' tie too many values together to count or "
        "cover its "
        "keys\n"
        "  help: simplify tiny.toml:18, tiny.toml:15, or vary fewer features with --over\n");
    KeySpaceLimits limits;
    limits.over = {3};
    EXPECT_EQ(space_of(family, "450", limits).count(), 4097u);
}

TEST(KeySpace, SaysWhereNoRuleButTheFeaturesAreTooMany) {
    const Result<KeySpace> space = KeySpace::make(family_of(counts(1000, 4096)), "450", {});
    ASSERT_FALSE(space);
    EXPECT_EQ(first_text(space.error()),
              "gobo: error: family 'tiny' has too many features and values to count or cover its keys\n"
              "  help: give it fewer features, or its counts smaller ranges\n");
}

TEST(KeySpace, ListsMoreFeaturesThanTheStackHasRoomForCalls) {
    KeySpaceLimits limits;
    limits.over = {7};
    Key on(200'000, 0);
    on[7] = 1;
    EXPECT_THAT(space_of(family_of(defines(200'000)), "450", limits).keys(),
                testing::ElementsAre(Key(200'000, 0), on));
}

TEST(KeySpace, CountsBeyond64BitsExactly) {
    const WholeNumber defines_80 = space_of(family_of(defines(80))).count();
    EXPECT_EQ(defines_80.text(), "1208925819614629174706176") << "2^80";
    EXPECT_EQ(defines_80.saturated(), std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(space_of(family_of(counts(26, 15))).count().text(), "20282409603651670423947251286016")
        << "16^26";
    const std::string large = space_of(family_of(counts(100, 999))).count().text();
    EXPECT_EQ(large, "1" + std::string(300, '0')) << "1000^100";
    // All keys but one.
    const std::string forbidden = forbid("c00 + c01 + c02 + c03 + c04 + c05 + c06 > 6992");
    EXPECT_EQ(space_of(family_of(counts(7, 999) + forbidden)).count().text(), "999999999999999999999");
}

TEST(WholeNumber, SaturatesAboveThe64BitsOnly) {
    WholeNumber number = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(number.text(), "18446744073709551615");
    EXPECT_EQ(number.saturated(), std::numeric_limits<std::uint64_t>::max());
    number += 1;
    EXPECT_EQ(number.text(), "18446744073709551616");
    EXPECT_EQ(number.saturated(), std::numeric_limits<std::uint64_t>::max());
    number += number;
    EXPECT_EQ(number.text(), "36893488147419103232");
    number *= 4097;
    EXPECT_EQ(number.text(), "151152620939976065941504");
    number *= 0;
    EXPECT_EQ(number, 0U);
    WholeNumber below = 999'999'999'999'999'999;
    below += 1;
    EXPECT_EQ(below, 1'000'000'000'000'000'000U);
    EXPECT_EQ(below.text(), "1000000000000000000");
    EXPECT_EQ(WholeNumber().text(), "0");
}

}  // namespace
}  // namespace gobo
