// Studies of lit: what must hold of their numbers, whatever features it has.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "lab/study/qualities.hpp"
#include "lab/study/rows.hpp"
#include "study_support.hpp"

namespace gobo::study {
namespace {

/// One study that the tests below look at.
const Study& blinn_study() {
    static const Study study = [] {
        Journal journal;
        return run_study(lit_subject(), quick_options({"directional=1 fog=linear specular=blinn"}), journal)
            .value();
    }();
    return study;
}

const KeyResult* find(const EffectsResult& effects, const std::string& quality) {
    for (const KeyResult& result : effects.keys)
        if (quality_text(lit_under_study().family, result.key) == quality) return &result;
    return nullptr;
}

TEST(StudyOfLit, JudgesByTheOracle) {
    for (const Measurement& measured : blinn_study().effects.front().keys.front().scenes) {
        EXPECT_TRUE(measured.from_oracle);
        EXPECT_GT(measured.pixels, 1000u) << "a picture of little says little";
        EXPECT_LE(measured.edges * 100, measured.pixels) << "more than 1 % at a discontinuity";
    }
}

TEST(StudyOfLit, FindsNothingButRoundingInTheMostAccurateKey) {
    for (const Measurement& measured : blinn_study().effects.front().keys.front().scenes) {
        // As gobo test holds fp64 to the oracle: 1e-9 of the largest term, here a few units of radiance.
        EXPECT_LT(measured.approximation.max, 1e-8);
        EXPECT_EQ(measured.rate.max, 0);
        EXPECT_GT(measured.rounding.max, 0);
        // The error bound that gobo test holds fp32 to is a few 1e-5 for an exponent of 400.
        EXPECT_LT(measured.total.max, 2e-4);
    }
}

TEST(StudyOfLit, TellsShadingRateFromApproximation) {
    const KeyResult* vertex = find(blinn_study().effects.front(), "shading=vertex");
    ASSERT_NE(vertex, nullptr);
    for (const Measurement& measured : vertex->scenes) {
        EXPECT_LT(measured.approximation.max, 1e-8) << "at full rate it is exact";
        EXPECT_GT(measured.rate.max, 100 * measured.rounding.max);
        EXPECT_NEAR(measured.total.max, measured.rate.max, 1e-4);
    }
    const KeyResult* planar = find(blinn_study().effects.front(), "fog_distance=planar");
    ASSERT_NE(planar, nullptr);
    for (const Measurement& measured : planar->scenes) {
        EXPECT_EQ(measured.rate.max, 0) << "it is at full rate";
        EXPECT_NEAR(measured.total.max, measured.approximation.max, 1e-4);
    }
}

TEST(StudyOfLit, CountsLessWorkPerFragmentWhereVerticesDoIt) {
    const EffectsResult& effects = blinn_study().effects.front();
    const Weights& weights = lit_under_study().weights;
    const Costs accurate = costs_of(effects.keys.front().scenes.front(), weights);
    const Costs vertex = costs_of(find(effects, "shading=vertex")->scenes.front(), weights);
    EXPECT_LT(vertex.fragment, accurate.fragment);
    EXPECT_GT(vertex.vertex, accurate.vertex);
    EXPECT_LT(vertex.total, accurate.total);
}

TEST(StudyOfLit, SeesTheEdgesOfShadowsAndWhatIsDecidedThere) {
    const LitUnderStudy& lit = lit_under_study();
    Journal journal;
    const Study study =
        run_study(lit_subject(), quick_options({"directional=1 directional_shadows=1"}), journal).value();
    const EffectsResult& effects = study.effects.front();
    const Measurement& accurate = effects.keys.front().scenes.front();
    EXPECT_LE(accurate.edges * 100, accurate.pixels) << "more than 1 % at a discontinuity";
    EXPECT_LT(accurate.total.max, 1e-5) << "a comparison decided the other way by a rounding is an edge";
    // The rim of a shadow lies a texel's share of light off: most of one texel of the four.
    const KeyResult* nearest = find(effects, "shadow_filter=nearest");
    ASSERT_NE(nearest, nullptr);
    EXPECT_GT(nearest->scenes.front().total.max, 0.05);
    EXPECT_LT(costs_of(nearest->scenes.front(), lit.weights).fragment,
              costs_of(accurate, lit.weights).fragment);
}

TEST(StudyOfLit, SeesErrorsOfVertexShadingShrinkWithTessellation) {
    double before = HUGE_VAL;
    int stops = 0;
    for (const CurvePoint& point : blinn_study().curves) {
        if (point.feature != "shading" || point.value != "vertex") continue;
        EXPECT_LT(point.total.rms, before) << point.number << " slices";
        before = point.total.rms;
        ++stops;
    }
    EXPECT_GE(stops, 5);
}

TEST(StudyOfLit, GivesTheSameNumbersWhateverTheJobsAndHoweverOftenItStopped) {
    const LitUnderStudy& lit = lit_under_study();
    const auto run = [&](int jobs, Journal& journal) {
        const Study study =
            run_study(lit_subject(jobs), quick_options({"fog=linear point=1"}), journal).value();
        return study_csv(rows_of(lit.family, study, lit.weights)) + curves_csv(study.curves);
    };
    MemoryFileSystem files;
    const std::string path = "measurements.jsonl";
    Journal whole(files, path, append_to(files));
    const std::string expected = run(1, whole);
    // As if it had been interrupted in the middle of writing a line half way through.
    std::string text = files.read(path).value();
    MemoryFileSystem interrupted;
    ASSERT_TRUE(interrupted.write(path, text.substr(0, text.size() / 2)));
    Journal rest(interrupted, path, append_to(interrupted));
    EXPECT_EQ(run(2, rest), expected);
    Journal again(interrupted, path, append_to(interrupted));
    const std::size_t size = interrupted.read(path).value().size();
    EXPECT_EQ(run(2, again), expected);
    EXPECT_EQ(interrupted.read(path).value().size(), size) << "nothing was measured a third time";
}

TEST(StudyOfLit, NamesADominatorThatIsOnTheFront) {
    const LitUnderStudy& lit = lit_under_study();
    const auto rows = rows_of(lit.family, blinn_study(), lit.weights);
    std::map<std::pair<std::string, std::string>, const StudyRow*> by_name;
    for (const StudyRow& row : rows) by_name[{row.scene, row.key}] = &row;
    for (const StudyRow& row : rows) {
        EXPECT_EQ(row.on_front, row.dominated_by.empty());
        if (row.on_front) continue;
        const StudyRow& better = *by_name.at({row.scene, row.dominated_by});
        EXPECT_TRUE(better.on_front);
        EXPECT_LE(better.costs.total, row.costs.total);
        EXPECT_LE(better.total.max, row.total.max);
    }
}

TEST(Choices, SayWhatIsDominatedEverywhere) {
    // A family made for it: `slow` does what `good` does and wastes some more on it.
    const Family family = read_small_family();
    const SearchPath search = search_for_small_family();
    Journal journal;
    StudyOptions small_options = quick_options({"default"});
    small_options.plan = default_plan(family);
    const Result<Study> study = run_study({source_files(), family, search, 2}, small_options, journal);
    ASSERT_TRUE(study) << to_text(study.error().front());
    std::map<std::string, std::string> dominated;
    for (const ChoiceSummary& choice : summarise_choices(family, *study, lit_under_study().weights))
        dominated[choice.value] = choice.dominated_by;
    EXPECT_EQ(dominated, (std::map<std::string, std::string>{{"good", ""}, {"rough", ""}, {"slow", "good"}}));
}

}  // namespace
}  // namespace gobo::study
