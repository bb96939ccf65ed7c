// At any point the ubershader, its switches set, gives what the permutation gives that was made for it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/relations.hpp"
#include "lab/verify/sample.hpp"
#include "settings.hpp"
#include "uber_ports.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using verify::Sample;

constexpr int kPoints = 64;

/// Both add the same terms in the same order, at most one of them times 1: eight roundings of the largest
/// channel.
constexpr double kTolerance = 1e-6;

/// What a fragment stage gives at samples, in fp32.
class Fragments {
  public:
    Fragments(const Family& family, const std::vector<Key>& keys)
        : composition_(composed(family, keys)), validated_(validated(family, composition_)) {}

    /// The permutation's programs, decoded.
    [[nodiscard]] evaluate::Outputs run(std::size_t permutation, const std::vector<Sample>& samples) const {
        const int stage = composition_.permutations[permutation].stages[StageKind::fragment];
        const auto program =
            evaluate::decode(validated_.stages[static_cast<std::size_t>(stage)].spirv).value();
        return evaluate::run<float>(program, verify::bind_inputs(program, samples).value()).value();
    }

  private:
    static Composition composed(const Family& family, const std::vector<Key>& keys) {
        SearchPath search;
        uber::add_pieces(search);
        return compose(family, keys, search, Dialect::own).value();
    }

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
    verify::lay_fields_over_lit(uber::uber_field);
    const Family family = uber::family();
    const Key key = uber::switched_key(family, GetParam());
    const std::vector<Key> settings = uber::settings_of(family, key).value();
    EXPECT_GT(settings.size(), 80U);
    const std::vector<oracle::Model> models = uber::models_of(family, key);
    const Fragments specialised(family, settings);
    const Fragments switched(family, {key});
    for (std::size_t i = 0; i < settings.size(); ++i) {
        SCOPED_TRACE(key_text(family, settings[i]));
        const oracle::Model& model = models[i];
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
    const Family family = uber::family();
    const Key key = uber::switched_key(family, "switched");
    const std::vector<Key> settings = uber::settings_of(family, key).value();
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        const Feature& feature = family.features[i];
        if (feature.role != Role::effect) continue;
        for (int value = 0; value < static_cast<int>(feature.values.size()); ++value) {
            const std::string& name = feature.values[static_cast<std::size_t>(value)];
            if (name == "switched" || name == "looped") continue;
            EXPECT_TRUE(std::any_of(settings.begin(), settings.end(),
                                    [&](const Key& setting) { return setting[i] == value; }))
                << feature.name << "=" << name;
        }
    }
}

TEST(UberSettings, AreTheKeyItselfWithoutSwitches) {
    const Family family = uber::family();
    const Key key = parse_key(family, "directional=2 fog=linear").value();
    EXPECT_EQ(uber::settings_of(family, key).value(), std::vector<Key>{key});
    EXPECT_FALSE(uber::has_switches(family, key));
}

TEST(UberSettings, KeepWhatIsNoSwitch) {
    const Family family = uber::family();
    const Key key = parse_key(family,
                              "lighting=looped diffuse=switched fog_distance=planar fog=linear directional=1 "
                              "directional_shadows=1 spot=1")
                        .value();
    const std::vector<Key> settings = uber::settings_of(family, key).value();
    EXPECT_GT(settings.size(), 4U);
    for (const Key& setting : settings)
        EXPECT_NE(key_text(family, setting).find("fog=linear fog_distance=planar"), std::string::npos);
}

}  // namespace
}  // namespace gobo
