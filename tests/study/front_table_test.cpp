// The front of a finished study as readers see it: a short table, a chart, and which keys are on it by time.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/study/chip_fronts.hpp"
#include "lab/study/front.hpp"

namespace gobo::study {
namespace {

const Family& small_family() {
    static const Family family = read_family(R"(
name = "small"
vertex = "small.vert"
fragment = "small.frag"
[features.light]
count = [0, 2]
constant = "LIGHTS"
[features.power]
role = "quality"
values = ["exact", "near", "rough"]
[features.shading]
role = "quality"
values = ["fragment", "vertex"]
)",
                                             "small.toml")
                                     .value();
    return family;
}

Key key_of(const std::string& text) {
    return parse_key(small_family(), text).value();
}

constexpr const char* kStudy =
    "effects,key,scene,error_max,error_rms,cost,front\n"
    "light=1,light=1,*,2e-07,1e-08,1234,yes\n"
    "light=1,light=1,teapot,2e-07,1e-08,100,yes\n"
    "light=1,light=1 power=near,*,8e-07,2e-08,1200,yes\n"
    "light=1,light=1 power=rough,*,0.02,0.003,900,yes\n"
    "light=1,light=1 shading=vertex,*,0.3,0.1,20.4,yes\n"
    "light=1,light=1 power=near shading=vertex,*,0.4,0.1,30,no\n"
    "light=2,light=2,*,3e-07,2e-08,1300,yes\n";

TEST(FrontTable, HasTheCheapestQualityWithinEachPowerOfTen) {
    const auto rows = read_rows(kStudy, "study.csv", small_family(), key_of("light=1"));
    ASSERT_TRUE(rows);
    EXPECT_EQ(front_table(*rows),
              "| quality | largest error | RMS error | worst of the domain | cost, additions | time, ns |\n"
              "|---|---|---|---|---|---|\n"
              "| most accurate | 2.0e-07 | 1.0e-08 | \u2013 | 1234 |  |\n"
              "| `power=near` | 8.0e-07 | 2.0e-08 | \u2013 | 1200 |  |\n"
              "| `power=rough` | 0.02 | 0.003 | \u2013 | 900 |  |\n"
              "| `shading=vertex` | 0.3 | 0.1 | \u2013 | 20.4 |  |\n");
}

struct AlikeRow {
    const char* name;
    const char* error;
    const char* worst;
    bool is_alike;  ///< to the most accurate key, which is dearer
};

class Alike : public testing::TestWithParam<AlikeRow> {};

TEST_P(Alike, RowsAreOneOnTheFront) {
    const std::string study = fmt::format(
        "effects,key,scene,error_max,error_rms,cost,front,error_worst\n"
        "light=1,light=1,*,2e-07,1e-08,1234,yes,0\n"
        "light=1,light=1 power=near,*,{},2e-08,1200,yes,{}\n"
        "light=1,light=1 shading=vertex,*,0.3,0.1,20.4,yes,none\n",
        GetParam().error, GetParam().worst);
    const auto rows = read_rows(study, "study.csv", small_family(), key_of("light=1"));
    ASSERT_TRUE(rows);
    const std::string table = front_table(*rows);
    EXPECT_EQ(table.find("most accurate") == std::string::npos, GetParam().is_alike) << table;
    EXPECT_NE(table.find("`power=near`"), std::string::npos) << table;
    EXPECT_NE(table.find("| not promised |"), std::string::npos) << table;
}

INSTANTIATE_TEST_SUITE_P(Rows, Alike,
                         testing::Values(AlikeRow{"within_rounding", "3e-07", "0", true},
                                         AlikeRow{"beyond_rounding", "7e-07", "0", false},
                                         AlikeRow{"on_scenes_only", "3e-07", "0.5", false},
                                         AlikeRow{"where_one_was_searched", "3e-07", "", false}),
                         [](const auto& row) { return row.param.name; });

TEST(FrontTable, FillsItsLinesWithWhatLiesFurthestBetween) {
    std::string study = kStudy;
    for (const char* row : {"light=1,light=1 power=rough shading=vertex,*,0.1,0.01,600,yes\n",
                            "light=1,light=1 power=near shading=vertex,*,0.2,0.02,25,yes\n",
                            "light=1,light=1 power=exact shading=vertex,*,0.25,0.02,22,yes\n"})
        study += row;
    const auto rows = read_rows(study, "study.csv", small_family(), key_of("light=1"));
    ASSERT_TRUE(rows) << to_text(rows.error().front());
    const std::string table = front_table(*rows);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + 6);
    EXPECT_NE(table.find("| 600 |"), std::string::npos) << table;
    EXPECT_NE(table.find("| 25 |"), std::string::npos) << table;
    EXPECT_EQ(table.find("| 22 |"), std::string::npos) << table;
}

TEST(FrontTable, NumbersTheFrontInItsChart) {
    const auto rows = read_rows(kStudy, "study.csv", small_family(), key_of("light=1")).value();
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    const std::string svg = front_chart(small_family(), {"shading"}, all, "light=1").svg();
    for (const char* part :
         {">4</text>", ">shading=vertex</text>", ">hollow: dominated</text>",
          "data-key=\"light=1 power=rough\"", ">weighted cost of a fragment, in additions</text>"})
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    EXPECT_EQ(svg.find(">5</text>"), std::string::npos) << "what is dominated has no number";
}

/// Cheaper by additions, dearer on a chip: the near power.
constexpr const char* kChips =
    "effects,key,scene,error_max,error_rms,cost,front,cycles_navi21,front_navi21,driver_navi21,instructions_"
    "navi21\n"
    "light=1,light=1,*,2e-07,1e-08,1200,yes,400,yes,\"RDNA2, radv Mesa 1\",arithmetic 90 transcendental 8\n"
    "light=1,light=1 power=near,*,8e-07,2e-08,1000,yes,440,no,\"RDNA2, radv Mesa 1\",arithmetic 99 "
    "transcendental 6\n"
    "light=1,light=1 power=rough,*,0.02,0.003,900,yes,,,\"RDNA2, radv Mesa 1\",arithmetic 60\n"
    "light=1,light=1 shading=vertex,*,0.3,0.1,120,yes,50,yes,\"RDNA2, radv Mesa 1\",arithmetic 9\n"
    "light=1,light=1,teapot,2e-07,1e-08,1200,yes,400,yes,\"RDNA2, radv Mesa 1\",arithmetic 90\n"
    "light=1,light=1 shading=vertex,teapot,0.3,0.1,120,no,50,yes,\"RDNA2, radv Mesa 1\",arithmetic 9\n";

TEST(ChipFronts, StandSideBySide) {
    const auto rows = read_rows(kChips, "study.csv", small_family(), key_of("light=1")).value();
    const auto measures = measures_of(rows, {"navi21"}).value();
    EXPECT_EQ(fronts_table(rows, measures),
              "| quality | largest error | llvmpipe, additions | navi21, cycles |\n"
              "|---|---|---|---|\n"
              "| most accurate | 2.0e-07 | **1200** | **400** |\n"
              "| `power=near` | 8.0e-07 | **1000** | 440 |\n"
              "| `power=rough` | 0.02 | **900** | \u2013 |\n"
              "| `shading=vertex` | 0.3 | **120** | **50** |\n");
}

TEST(ChipFronts, TellWhatChangesPlacesAndWhy) {
    const auto rows = read_rows(kChips, "study.csv", small_family()).value();
    const auto measures = measures_of(rows, {}).value();
    EXPECT_EQ(
        changed_places_table(small_family(), rows, measures),
        "| feature | value | against | llvmpipe | navi21 | instructions more | pairs |\n"
        "|---|---|---|---|---|---|---|\n"
        "| power | `near` | `exact` | \u00d70.83 | \u00d71.10 | navi21: arithmetic +9, transcendental -2 | 1 "
        "|\n");
    EXPECT_EQ(values_table(small_family(), rows, measures),
              "| feature | value | matters in | llvmpipe | navi21 |\n"
              "|---|---|---|---|---|\n"
              "| power | `exact` | 1 | 1 | 1 |\n"
              "| power | `near` | 1 | 1 | 0 |\n"
              "| power | `rough` | 1 | 1 | 0 |\n"
              "| shading | `fragment` | 2 | 2 | 2 |\n"
              "| shading | `vertex` | 2 | 1 | 2 |\n");
}

TEST(ChipFronts, AreDrawnOneAboveAnotherWithTheSameNumbers) {
    const auto rows = read_rows(kChips, "study.csv", small_family(), key_of("light=1")).value();
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    const auto measures = measures_of(rows, {}).value();
    const std::string svg = fronts_svg(small_family(), {"shading"}, all, "light=1", measures);
    const auto count = [&](const std::string& part) {
        std::size_t found = 0;
        for (std::size_t at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("<svg"), 3U);
    EXPECT_EQ(count(">4</text>"), 2U) << "shading=vertex, on both";
    EXPECT_EQ(count(">3</text>"), 1U) << "power=rough, on one";
    EXPECT_EQ(count(">navi21: cycles (RDNA2, radv Mesa 1)</text>"), 1U);
    const std::string page = fronts_page(small_family(), {"shading"}, rows, measures);
    EXPECT_NE(page.find("<td>near</td>"), std::string::npos);
    EXPECT_NE(page.find("<h2>light=1</h2>"), std::string::npos);
}

TEST(ChipFronts, OfChipsThatNobodyCostedAreRefused) {
    const auto rows = read_rows(kChips, "study.csv", small_family()).value();
    EXPECT_EQ(to_text(measures_of(rows, {"ampere"}).error().front()),
              "gobo: error: the study holds no cycles of ampere\n"
              "  help: add them: gobo cost FAMILY --study FILE --gpu ampere > NEW\n");
}

struct BadStudy {
    const char* name;
    const char* csv;
    const char* effects;
    const char* message;
    int line;
};

class BadStudies : public testing::TestWithParam<BadStudy> {};

TEST_P(BadStudies, AreRefused) {
    const auto rows = read_rows(GetParam().csv, "study.csv", small_family(), key_of(GetParam().effects));
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().front().message, GetParam().message);
    EXPECT_EQ(rows.error().front().place.line, GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, BadStudies,
    testing::Values(BadStudy{"no_study", "a,b\n1,2\n", "light=1", "has no column 'effects'", 2},
                    BadStudy{"other_effects", kStudy, "default", "holds no 'default'", 2},
                    BadStudy{"unknown_key",
                             "effects,key,scene,error_max,cost,front\nlight=1,light=1 power=odd,*,1,1,yes\n",
                             "light=1", "feature 'power' has no value 'odd'", 2}),
    [](const auto& row) { return row.param.name; });

/// A study of one scene: error, cost and range of times of each key.
struct TimedKey {
    const char* key;
    double error;
    Spread time;
    bool on_front;
};

Study timed_study(const std::vector<TimedKey>& keys, double control) {
    Study study;
    study.scenes = {"teapot"};
    EffectsResult& effects = study.effects.emplace_back();
    effects.effects = key_of("light=1");
    effects.control = Control{control, control};
    for (const TimedKey& one : keys) {
        KeyResult& result = effects.keys.emplace_back();
        result.key = key_of(one.key);
        Measurement& measured = result.scenes.emplace_back();
        measured.pixels = 100;
        measured.total.max = one.error;
        Timing timing;
        timing.renderer = "llvmpipe";
        timing.processor.fragment = one.time;
        result.timing = timing;
    }
    return study;
}

TEST(FrontByTime, HoldsWhomNobodyAsAccurateIsMeasurablyFaster) {
    const std::vector<TimedKey> keys = {
        {"light=1", 1e-7, {10, 9, 11}, true},
        {"light=1 power=near", 1e-6, {9.5, 8.5, 10}, true},  // overlaps the first
        {"light=1 power=rough", 1e-3, {12, 11.5, 13}, false},
        {"light=1 shading=vertex", 0.1, {2, 1.9, 2.1}, true}};
    const auto rows = rows_of(small_family(), timed_study(keys, 0.01), {});
    for (std::size_t i = 0; i < keys.size(); ++i) {
        ASSERT_TRUE(rows[2 * i].on_time_front) << keys[i].key;
        EXPECT_EQ(*rows[2 * i].on_time_front, keys[i].on_front) << keys[i].key;
        EXPECT_FALSE(rows[2 * i + 1].on_time_front) << "times are not of single scenes";
    }
}

struct Summary {
    const char* name;
    const char* renderer;
    Control control;
    const char* text;
};

constexpr const char* kRanks =
    "rank correlation of cost and time: fragments 0.00, vertices 0.00, over 1 permutations\n";
constexpr const char* kNotRanked =
    "1 of 1 permutations are not ranked by time: their control is off by more than 2 %\n";
const Summary kSummaries[] = {
    {"the elapsed time does not count",
     "llvmpipe (LLVM 15.0.6, 256 bits)",
     {0.58, 0.01},
     "A/A control, worst: elapsed 58.0 %, processor 1.0 %; processor time counts\n"},
    {"the processor's fails",
     "llvmpipe (LLVM 15.0.6, 256 bits)",
     {0.01, 0.03},
     "A/A control, worst: elapsed 1.0 %, processor 3.0 %; processor time counts\n"},
    {"a GPU's time",
     "GPU by GL_TIME_ELAPSED",
     {0.01, 0.58},
     "A/A control, worst: elapsed 1.0 %, processor 58.0 %; elapsed time counts\n"},
    {"a GPU whose clock fails",
     "GPU by GL_TIME_ELAPSED",
     {1, 0.01},
     "A/A control, worst: elapsed 100.0 %, processor 1.0 %; elapsed time counts\n"},
};

TEST(FrontByTime, SaysWhichClockCounts) {
    for (const Summary& row : kSummaries) {
        Study study = timed_study({{"light=1", 1e-7, {10, 9, 11}, true}}, 0);
        study.effects.front().control = row.control;
        study.effects.front().keys.front().timing->renderer = row.renderer;
        const bool holds = row.control.ranked(row.renderer) <= kLargestControl;
        EXPECT_EQ(times_summary(study, {}), std::string(row.text) + (holds ? kRanks : kNotRanked))
            << row.name;
    }
}

TEST(FrontByTime, IsNotDrawnWhereTheControlFails) {
    const auto rows = rows_of(small_family(), timed_study({{"light=1", 1e-7, {10, 9, 11}, true}}, 0.03), {});
    EXPECT_FALSE(rows.front().on_time_front);
}

}  // namespace
}  // namespace gobo::study
