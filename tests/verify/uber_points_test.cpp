// At any point the ubershader, its switches set, gives what the permutation gives that was made for it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "family/key.hpp"
#include "lit_library.hpp"
#include "lab/oracle/settings.hpp"
#include "validate/validate.hpp"
#include "lab/verify/decoded.hpp"
#include "lab/verify/feed.hpp"
#include "lab/verify/sample.hpp"

namespace gobo {
namespace {

using verify::Sample;

constexpr int kPoints = 64;

/// Both add the same terms in the same order, at most one of them times 1: eight roundings of the largest
/// channel.
constexpr double kTolerance = 1e-6;

Key key_of(const Family& family, const char* lighting) {
    Key key = default_key(family);
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& feature = family.features[i];
        const auto value = feature.index_of(feature.name == "lighting" ? lighting : "switched");
        if (value) key[i] = *value;
    }
    return key;
}

/// What a fragment stage gives at samples, in fp32.
class Fragments {
  public:
    Fragments(const Family& family, const std::vector<Key>& keys)
        : composition_(compose_lit(family, keys, {}).value()), validated_(validated(family, composition_)) {}

    /// The permutation's programs, decoded.
    [[nodiscard]] evaluate::Outputs run(std::size_t permutation, const std::vector<Sample>& samples) const {
        const int stage = composition_.permutations[permutation].fragment;
        const auto program =
            evaluate::decode(validated_.stages[static_cast<std::size_t>(stage)].spirv).value();
        return evaluate::run<float>(program, verify::feed(program, samples).value()).value();
    }

  private:
    static Validated validated(const Family& family, const Composition& composition) {
        ValidateOptions options;
        options.keep_spirv = true;
        return validate(family, composition, options);
    }

    Composition composition_;
    Validated validated_;
};

double channel(const evaluate::Outputs& outputs, std::size_t point, std::size_t number) {
    return outputs.values.at("fragmentColor")[number * outputs.count + point];
}

/// Checks one point.
void expect_same(const evaluate::Outputs& actual, const evaluate::Outputs& expected, std::size_t point) {
    ASSERT_EQ(actual.discarded[point], expected.discarded[point]);
    if (expected.discarded[point]) return;
    double brightest = 1;
    for (std::size_t c = 0; c < 4; ++c) brightest = std::max(brightest, channel(expected, point, c));
    for (std::size_t c = 0; c < 4; ++c)
        ASSERT_NEAR(channel(actual, point, c), channel(expected, point, c), kTolerance * brightest)
            << "channel " << c << " at point " << point;
}

class UberPoints : public testing::TestWithParam<const char*> {};

TEST_P(UberPoints, AreThoseOfEachPermutation) {
    const Family family = uber_family();
    const Key uber = key_of(family, GetParam());
    const std::vector<Key> settings = oracle::settings_of(family, uber).value();
    EXPECT_GT(settings.size(), 80U);
    const Fragments specialised(family, settings);
    const Fragments switched(family, {uber});
    for (std::size_t i = 0; i < settings.size(); ++i) {
        SCOPED_TRACE(key_text(family, settings[i]));
        const oracle::Model model = oracle::model_of(family, settings[i]).value();
        const auto samples =
            verify::rounded_to_float(verify::make_samples(model, StageKind::fragment, kPoints, i));
        const evaluate::Outputs expected = specialised.run(i, samples);
        const evaluate::Outputs actual = switched.run(0, samples);
        for (std::size_t point = 0; point < samples.size(); ++point) expect_same(actual, expected, point);
        if (HasFatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, UberPoints, testing::Values("switched", "looped"),
                         [](const auto& row) { return std::string(row.param); });

/// What the settings leave out: nothing that lit's effects know.
TEST(UberSettings, HoldEveryEffectOfLit) {
    const Family lit = lit_family();
    const Family uber = uber_family();
    const Key key = key_of(uber, "switched");
    const std::vector<Key> settings = oracle::settings_of(uber, key).value();
    for (std::size_t i = 0; i < lit.features.size(); ++i) {
        const Feature& feature = lit.features[i];
        if (feature.role != Role::effect) continue;
        for (int value = 0; value < static_cast<int>(feature.values.size()); ++value) {
            const bool is_there = std::any_of(settings.begin(), settings.end(), [&](const Key& setting) {
                return setting[static_cast<std::size_t>(*uber.index_of(feature.name))] == value;
            });
            EXPECT_TRUE(is_there) << feature.name << "=" << feature.values[static_cast<std::size_t>(value)];
        }
    }
}

TEST(UberSettings, AreTheKeyItselfWithoutSwitches) {
    const Family family = uber_family();
    const Key key = parse_key(family, "directional=2 fog=linear").value();
    EXPECT_EQ(oracle::settings_of(family, key).value(), std::vector<Key>{key});
    EXPECT_FALSE(oracle::has_switches(family, key));
}

TEST(UberSettings, KeepWhatIsNoSwitch) {
    const Family family = uber_family();
    const Key key =
        parse_key(family, "lighting=looped diffuse=switched fog_distance=planar fog=linear").value();
    const std::vector<Key> settings = oracle::settings_of(family, key).value();
    EXPECT_GT(settings.size(), 4U);
    for (const Key& setting : settings)
        EXPECT_NE(key_text(family, setting).find("fog=linear fog_distance=planar"), std::string::npos);
}

}  // namespace
}  // namespace gobo
