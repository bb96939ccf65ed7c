// Tables of costs, and what has grown since one was kept.
#include <gtest/gtest.h>

#include "core/text.hpp"
#include "cost_support.hpp"
#include "lab/cost/baseline.hpp"

namespace gobo::cost {
namespace {

/// One key on one chip, one stage.
std::vector<ChipCost> costs(std::uint64_t instructions, std::uint64_t registers, std::uint64_t cycles,
                            bool has_loop, const std::string& driver = "radv Mesa 1") {
    StageCost stage;
    stage.stage = "fragment";
    stage.instructions = instructions;
    stage.vector_registers = registers;
    stage.cycles = cycles;
    stage.has_loop = has_loop;
    stage.kinds[0] = instructions;
    return {{chips_of({"navi21"}).front(), driver, {{"fog=linear", {stage}}}}};
}

struct Growth {
    std::string name;
    std::vector<ChipCost> now;
    std::string text;  ///< the messages
};

class Baselines : public testing::TestWithParam<Growth> {};

TEST_P(Baselines, SayWhatHasGrown) {
    const CsvTable baseline = to_table(costs(100, 24, 500, false));
    const auto comparison = compare_with_baseline(GetParam().now, baseline, "costs.csv", 2);
    EXPECT_EQ(to_text(comparison ? comparison->diagnostics : comparison.error()), GetParam().text);
}

std::vector<ChipCost> renamed(std::vector<ChipCost> all, const std::string& key) {
    all.front().keys.front().key = key;
    return all;
}

std::vector<ChipCost> with_another_key(std::vector<ChipCost> all) {
    all.front().keys.push_back({"fog=exponential", all.front().keys.front().stages});
    return all;
}

INSTANTIATE_TEST_SUITE_P(
    Cost, Baselines,
    testing::Values(
        Growth{"Nothing", costs(100, 24, 500, false), ""},
        Growth{"WithinTheTolerance", costs(102, 24, 510, false), ""},
        Growth{"Less", costs(50, 16, 200, false), ""},
        Growth{"Instructions", costs(103, 24, 500, false),
               "gobo: error: the fragment stage has grown on navi21: instructions 100 -> 103 (+3.0 %) "
               "[fog=linear]\n"
               "  help: arithmetic +3 instructions; if that is meant, write it anew with --update\n"},
        Growth{"RegistersAndCycles", costs(100, 32, 600, false),
               "gobo: error: the fragment stage has grown on navi21: VGPRs 24 -> 32 (+33.3 %), cycles 500 -> "
               "600 "
               "(+20.0 %) [fog=linear]\n  help: if that is meant, write it anew with --update\n"},
        Growth{"CyclesOfALoop", costs(100, 24, 5000, true), ""},
        Growth{"AnotherDriver", costs(100, 24, 500, false, "radv Mesa 2"),
               "costs.csv: error: its figures of navi21 are from radv Mesa 1, and here is radv Mesa 2: two "
               "versions' "
               "estimates cannot be compared\n  help: write it anew with --update\n"},
        Growth{"OnlyAnotherKey", renamed(costs(100, 24, 500, false), "point=1"),
               "costs.csv: error: it holds nothing of what was measured, such as the fragment stage of "
               "'point=1' on "
               "navi21\n  help: write it anew with --update\n"},
        Growth{"AKeyMore", with_another_key(costs(100, 24, 500, false)),
               "costs.csv: error: it lacks the fragment stage of 'fog=exponential' on navi21\n"
               "  help: write it anew with --update\n"}),
    [](const auto& growth) { return growth.param.name; });

TEST(Baseline, TellsOfWhatIsNoLongerMeasured) {
    const CsvTable baseline = to_table(with_another_key(costs(100, 24, 500, false)));
    const auto now = costs(100, 24, 500, false);
    const auto comparison = compare_with_baseline(now, baseline, "costs.csv", 2);
    ASSERT_TRUE(comparison);
    ASSERT_EQ(comparison->diagnostics.size(), 1U);
    EXPECT_EQ(to_text(comparison->diagnostics.front()),
              "costs.csv: note: it also holds what was not measured now: the fragment stage of "
              "'fog=exponential' on navi21\n");
    EXPECT_EQ(rows_lost(baseline, to_table(now)), 1U);
    EXPECT_EQ(rows_lost(to_table(now), baseline), 0U);
    EXPECT_EQ(rows_lost(read_csv("no,table\n1,2\n"), baseline), 0U);
}

TEST(Baseline, HoldsComputeStages) {
    auto before = costs(100, 24, 500, false);
    before.front().keys.front().stages.front().stage = "compute";
    auto now = before;
    now.front().keys.front().stages.front().cycles = 1000;
    const auto comparison = compare_with_baseline(now, to_table(before), "costs.csv", 2);
    ASSERT_TRUE(comparison);
    ASSERT_EQ(comparison->diagnostics.size(), 1U);
    EXPECT_EQ(
        to_text(comparison->diagnostics.front()),
        "gobo: error: the compute stage has grown on navi21: cycles 500 -> 1000 (+100.0 %) [fog=linear]\n"
        "  help: if that is meant, write it anew with --update\n");
}

TEST(Baseline, LeavesOutCyclesThatWereGuessed) {
    const CsvTable guessed = to_table(costs(100, 24, 300, true));
    const auto comparison = compare_with_baseline(costs(100, 24, 500, false), guessed, "costs.csv", 2);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->grown, 0U);
}

struct WrongTable {
    std::string name;
    std::string change;   ///< "COLUMN=CELL" in the first row; "twice": that row a second time
    std::string message;  ///< without its help
};

class WrongTables : public testing::TestWithParam<WrongTable> {};

TEST_P(WrongTables, AreErrorsAtTheirLines) {
    CsvTable table = to_table(costs(1, 2, 3, false));
    const auto parts = split(GetParam().change, '=');
    if (GetParam().change == "twice")
        table.rows.push_back(table.rows.front());
    else
        table.rows.front()[table.column(parts[0]).value()] = parts.size() > 1 ? parts[1] : "";
    const auto comparison = compare_with_baseline(costs(1, 2, 3, false), table, "costs.csv", 0);
    ASSERT_FALSE(comparison);
    EXPECT_EQ(to_text(comparison.error().front()),
              "costs.csv:" + GetParam().message + "\n  help: write it anew with --update\n");
}

INSTANTIATE_TEST_SUITE_P(
    Cost, WrongTables,
    testing::Values(
        WrongTable{"Word", "cycles=many", "2: error: 'many' is no whole number of cycles"},
        WrongTable{"NaN", "cycles=nan", "2: error: 'nan' is no whole number of cycles"},
        WrongTable{"Infinity", "cycles=inf", "2: error: 'inf' is no whole number of cycles"},
        WrongTable{"Fraction", "cycles=67.5", "2: error: '67.5' is no whole number of cycles"},
        WrongTable{"Negative", "cycles=-1", "2: error: '-1' is no whole number of cycles"},
        WrongTable{"Exponent", "cycles=1e3", "2: error: '1e3' is no whole number of cycles"},
        WrongTable{"EmptyCell", "cycles=", "2: error: '' is no whole number of cycles"},
        WrongTable{"LoopOf2", "loop=2", "2: error: '2' is no answer to whether there is a loop, 0 or 1"},
        WrongTable{"UnknownGpu", "gpu=navi99", "2: error: 'navi99' is no GPU that gobo knows"},
        WrongTable{"UnknownStage", "stage=pixel", "2: error: 'pixel' is no stage that is costed"},
        WrongTable{"RowTwice", "twice",
                   "3: error: the fragment stage of 'fog=linear' on navi21 is here a second time"}),
    [](const auto& row) { return row.param.name; });

TEST(Baseline, NeedsItsColumns) {
    EXPECT_EQ(to_text(compare_with_baseline({}, read_csv("gpu,key\n"), "costs.csv", 0).error().front()),
              "costs.csv:1: error: there is no column 'stage'\n  help: name a table that --update wrote\n");
}

TEST(Cycles, StandSideBySide) {
    std::vector<ChipCost> all = with_another_key(costs(100, 24, 500, false));
    all.push_back({chips_of({"gfx1201"}).front(), "radv Mesa 2", costs(80, 24, 50, true).front().keys});
    EXPECT_EQ(cycles_text(all),
              "navi21 (RDNA2), radv Mesa 1\n"
              "gfx1201 (RDNA4), radv Mesa 2\n"
              "navi21  gfx1201  stage     key\n"
              "   500      *50  fragment  fog=linear\n"
              "   500           fragment  fog=exponential\n"
              "* with a loop, of which the compiler guesses how often it runs\n");
}

TEST(Differences, AreToldByFigureAndKind) {
    std::vector<ChipCost> all = costs(100, 24, 500, false);
    all.front().keys.push_back(renamed(costs(90, 24, 400, false), "fog=none").front().keys.front());
    EXPECT_EQ(difference_text(all, "fog=linear", "fog=none"),
              "navi21, fragment stage\n"
              "  instructions    100 ->    90    -10  -10.0 %\n"
              "  cycles          500 ->   400   -100  -20.0 %\n"
              "  instructions by kind: arithmetic -10\n");
}

}  // namespace
}  // namespace gobo::cost
