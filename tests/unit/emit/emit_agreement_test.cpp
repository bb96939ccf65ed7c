// What a generated header says of a key is what the compiler says of it.
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "family/key.hpp"
#include "large.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

/// The header's key with these value indices, set member by member as an application would.
large::Key header_key(const Key& values) {
    large::Key key;
    key.depth = static_cast<large::Depth>(values[0]);
    key.diffuse = static_cast<large::Diffuse>(values[1]);
    key.directional = values[2];
    key.fog = static_cast<large::Fog>(values[3]);
    key.fog_distance = static_cast<large::FogDistance>(values[4]);
    key.point = values[5];
    key.shading = static_cast<large::Shading>(values[6]);
    key.specular = static_cast<large::Specular>(values[7]);
    key.spot = values[8];
    return key;
}

class GeneratedHeaderAgreement : public testing::Test {
  protected:
    const sample::Built built_ = sample::large(large::permutations.size());

    Key random_key() {
        Key key;
        for (const Feature& feature : built_.family.features) {
            key.push_back(static_cast<int>(random_() % feature.values.size()));
        }
        return key;
    }

  private:
    std::mt19937 random_{3};
};

TEST_F(GeneratedHeaderAgreement, OnCanonicalKeysAndRefusals) {
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Key key = random_key();
        const Key expected = canonical(built_.family, key, "450");
        const large::Key actual = header_key(key);
        ASSERT_EQ(large::canonical(actual), header_key(expected)) << key_text(built_.family, key);
        ASSERT_EQ(large::key_text(actual), key_text(built_.family, expected));
        const Rule* rule = forbidding_rule(built_.family, expected, "450");
        ASSERT_EQ(large::detail::refusal(large::canonical(actual)), rule != nullptr ? rule->reason : "");
        refused += rule != nullptr ? 1 : 0;
    }
    EXPECT_GT(refused, 100) << "the keys tried are too tame";
}

TEST_F(GeneratedHeaderAgreement, OnEveryPermutation) {
    const Composition& composition = built_.composition;
    for (const Permutation& permutation : composition.permutations) {
        const large::Permutation* found = large::find(header_key(permutation.key));
        ASSERT_NE(found, nullptr) << key_text(built_.family, permutation.key);
        ASSERT_EQ(found->key(), header_key(permutation.key));
        ASSERT_EQ(
            found->vertex.source(),
            source_of(composition,
                      composition.stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])]));
        ASSERT_EQ(
            found->fragment.source(),
            source_of(composition,
                      composition.stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])]));
    }
}

TEST_F(GeneratedHeaderAgreement, OnWhatWasNotBuilt) {
    std::set<Key> built;
    for (const Permutation& permutation : built_.composition.permutations) built.insert(permutation.key);
    int missing = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Key key = random_key();
        const bool expected = built.contains(canonical(built_.family, key, "450"));
        ASSERT_EQ(large::find(header_key(key)) != nullptr, expected) << key_text(built_.family, key);
        missing += expected ? 0 : 1;
    }
    EXPECT_GT(missing, 100) << "the keys tried are too tame";
}

}  // namespace
}  // namespace gobo
