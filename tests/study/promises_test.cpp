// The error that a budget promises holds on scenes that no study saw, for effects that it saw and for others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "held_out_scenes.hpp"
#include "lab/study/qualities.hpp"
#include "study_support.hpp"

namespace gobo::study {
namespace {

const StudiedEffects& shipped_study() {
    static const StudiedEffects studied = [] {
        const std::string path = "data/study/lit.csv";
        if (!source_files().is_file(path)) return StudiedEffects{};
        return read_studied(source_files().read(path).value(), path, lit_under_study().family).value();
    }();
    return studied;
}

/// What is known of some effects: by the shipped study, or measured as gobo build does it.
std::vector<StudiedKey> known_of(const Key& effects) {
    if (const auto found = shipped_study().find(effects); found != shipped_study().end())
        return found->second;
    const LitUnderStudy& lit = lit_under_study();
    Journal journal;
    auto keys = front_qualities(lit.family, shipped_study(), effects);
    if (shipped_study().empty())
        for (const Choice& choice : single_choices(lit.family, effects)) keys.push_back(choice.key);
    return studied_keys(measure_keys(lit_subject(), effects, keys, quick_options({}).plan, journal).value(),
                        lit.weights);
}

struct Effects {
    const char* name;
    const char* key;
    bool is_studied;
};

class Promises : public testing::TestWithParam<Effects> {};

TEST_P(Promises, HoldOnScenesThatNoStudySaw) {
    const LitUnderStudy& lit = lit_under_study();
    const Key effects = lit_key(GetParam().key);
    if (!shipped_study().empty()) {
        ASSERT_EQ(shipped_study().contains(effects), GetParam().is_studied);
    }
    const std::vector<StudiedKey> known = known_of(effects);
    std::map<Key, double> promised;  // each chosen key with the least budget that chose it
    for (const double budget : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4}) {
        const auto chosen = choose(known, {.max_error = budget}, GetParam().key);
        ASSERT_TRUE(chosen) << "even the most accurate quality errs by more than " << budget;
        promised[chosen->key] = budget;
    }
    std::vector<Key> keys = {most_accurate(lit.family, effects)};
    for (const auto& [key, budget] : promised) keys.push_back(key);
    const Variants variants = load_variants(lit_subject(), keys).value();
    double closest = 0;
    for (const DrawnScene& scene : held_out_scenes(lit.family)) {
        const ScenePoints points = find_points(lit.family, variants.at(keys.front()), scene).value();
        for (const auto& [key, budget] : promised) {
            const double error = measure(points, variants.at(key), variants.at(key)).value().total.max;
            EXPECT_LE(error, budget) << key_text(lit.family, key) << " on " << scene.name;
            closest = std::max(closest, error / budget);
        }
    }
    RecordProperty("closest", fmt::format("{:.2f} of the promise", closest));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Promises,
    testing::Values(Effects{"a_light", "directional=1", true},
                    Effects{"a_highlight", "directional=1 specular=blinn", true},
                    Effects{"three_points", "point=3 specular=blinn", true},
                    Effects{"spots", "specular=blinn spot=2", true},
                    Effects{"everything", "directional=1 fog=exponential point=1 specular=blinn spot=1",
                            true},
                    Effects{"fog", "directional=1 fog=linear", true},
                    Effects{"many_lights", "directional=2 point=5 specular=phong", false},
                    Effects{"foggy_spot", "fog=exponential_squared spot=1", false},
                    Effects{"no_light", "fog=linear", false}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::study
