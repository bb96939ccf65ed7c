// The decision diagram against brute force, and covers against their definition.
#include "family/key_space.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "family/cover.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

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
        for (const bool retired : {false, true}) {
            KeySpaceLimits limits;
            limits.retired = retired;
            const KeySpace space(family, dialect, limits);
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
        EXPECT_EQ(KeySpace(family, "450", limits).keys(), keys_by_trying(family, "450", limits)) << feature;
    }
}

TEST_P(SmallFamily, ContainsExactlyWhatSomeKeyAgreesWith) {
    const KeySpace space(family, "450", {});
    const std::vector<Key> keys = space.keys();
    for (const PartialKey& partial : partial_keys(family)) {
        const bool expected =
            std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return agrees(partial, key); });
        ASSERT_EQ(space.contains(partial), expected) << testing::PrintToString(partial);
    }
}

/// A cover holds every combination of `strength` values that some key of the space holds, and nothing else.
void expect_cover(const std::vector<Key>& keys, const std::vector<Key>& covering, std::size_t strength) {
    const auto combinations = [&](const std::vector<Key>& of) {
        std::set<PartialKey> found;
        const std::function<void(const Key&, PartialKey&, std::size_t, std::size_t)> choose =
            [&](const Key& key, PartialKey& partial, std::size_t from, std::size_t left) {
                if (left == 0) found.insert(partial);
                for (std::size_t i = from; left > 0 && i + left <= key.size(); ++i) {
                    partial[i] = key[i];
                    choose(key, partial, i + 1, left - 1);
                    partial[i] = -1;
                }
            };
        for (const Key& key : of) {
            PartialKey partial(key.size(), -1);
            choose(key, partial, 0, strength);
        }
        return found;
    };
    EXPECT_EQ(combinations(covering), combinations(keys));
    EXPECT_TRUE(std::includes(keys.begin(), keys.end(), covering.begin(), covering.end()));
    EXPECT_LE(covering.size(), keys.size());
}

TEST_P(SmallFamily, IsCovered) {
    const KeySpace space(family, "450", {});
    for (int strength = 1; strength <= static_cast<int>(family.features.size()); ++strength) {
        SCOPED_TRACE(strength);
        expect_cover(space.keys(), cover(space, strength), static_cast<std::size_t>(strength));
        EXPECT_EQ(cover(space, strength), cover(KeySpace(family, "450", {}), strength)) << "not repeatable";
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
    const KeySpace space(family, "450", limits);
    const std::vector<Key> expected = keys_by_trying(family, "450", limits);
    ASSERT_EQ(space.keys(), expected);
    EXPECT_EQ(space.count(), expected.size());
    for (const int strength : {2, 3}) {
        const std::vector<Key> covering = cover(space, strength);
        expect_cover(expected, covering, static_cast<std::size_t>(strength));
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

TEST(KeySpace, CountsBeyond64BitsAsTheLargestNumber) {
    std::string body = "[features]\n";
    for (char name = 'a'; name <= 'z'; ++name)
        body += std::string(1, name) + " = { count = [0, 15], constant = \"" + name + "_COUNT\" }\n";
    EXPECT_EQ(KeySpace(family_of(body), "450", {}).count(), std::numeric_limits<std::uint64_t>::max())
        << "16^26 keys";
}

}  // namespace
}  // namespace gobo
