// Cycles beside the errors of a study, and the quality that they choose.
#include "lab/cost/study_cycles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "budget/budget.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo::cost {
namespace {

using testing::ElementsAre;

Family small_family() {
    return read_family(R"(
name = "small"
vertex = "small.vert"
fragment = "small.frag"
[features.power]
role = "quality"
values = ["exact", "rough", "wild", "wound"]
)",
                       "small.toml")
        .value();
}

CsvTable study() {
    return read_csv(
        "effects,key,scene,error_max,cost,front,vertices_per_fragment\n"
        "default,default,*,0.001,100,yes,0.5\n"
        "default,power=rough,*,0.01,60,yes,0.5\n"
        "default,power=wild,*,0.1,20,yes,0.5\n"
        "default,power=wound,*,0.1,10,yes,0.5\n");
}

KeyCost cost_of(const std::string& key, std::uint64_t vertex, std::uint64_t fragment, bool has_loop = false) {
    KeyCost cost{key, std::vector<StageCost>(2)};
    cost.stages[0].stage = "vertex";
    cost.stages[0].cycles = vertex;
    cost.stages[1].stage = "fragment";
    cost.stages[1].cycles = fragment;
    cost.stages[1].has_loop = has_loop;
    return cost;
}

KeyCost with_instructions(KeyCost cost) {
    cost.stages[1].kinds[0] = 30;
    cost.stages[1].kinds[3] = 4;
    return cost;
}

/// On vega10 the rough power is dearer than the exact one.
std::vector<ChipCost> costs() {
    const auto chips = chips_named({"navi21", "vega10"}).value();
    return {{chips[0],
             "radv Mesa 1",
             {cost_of("default", 20, 90), with_instructions(cost_of("power=rough", 20, 40)),
              cost_of("power=wild", 20, 30), cost_of("power=wound", 20, 5, true)}},
            {chips[1],
             "radv Mesa 1",
             {cost_of("default", 40, 80), cost_of("power=rough", 40, 120), cost_of("power=wild", 40, 30)}}};
}

std::vector<std::string> cells(const CsvTable& table, const std::string& column) {
    std::vector<std::string> all;
    for (const auto& row : table.rows) all.push_back(row[table.column(column).value()]);
    return all;
}

TEST(StudyCycles, CountAFragmentWithItsPartOfTheVertices) {
    const CsvTable table = with_cycles(study(), costs());
    EXPECT_THAT(cells(table, "cycles_navi21"), ElementsAre("100.0", "50.0", "40.0", ""));
    EXPECT_THAT(cells(table, "cycles_vega10"), ElementsAre("100.0", "140.0", "50.0", ""));
    EXPECT_THAT(cells(table, "front_navi21"), ElementsAre("yes", "yes", "yes", ""));
    EXPECT_THAT(cells(table, "front_vega10"), ElementsAre("yes", "no", "yes", ""));
    EXPECT_THAT(cells(table, "driver_vega10"), testing::Each("GCN5, radv Mesa 1"));
    EXPECT_THAT(cells(table, "instructions_navi21"), ElementsAre("", "arithmetic 30 move 4", "", ""));
    EXPECT_EQ(csv_text(with_cycles(table, costs())), csv_text(table)) << "measured anew, nothing is added";
}

TEST(StudyCycles, KeepWhatIsOnAChipsFrontInASummary) {
    CsvTable table = with_cycles(study(), costs());
    CsvTable summary = study();
    summary.rows.resize(1);
    EXPECT_THAT(cells(summary_of(table, summary), "key"),
                ElementsAre("default", "power=rough", "power=wild"));
    for (auto& row : table.rows) row[table.column("scene").value()] = "teapot";
    EXPECT_THAT(cells(summary_of(table, summary), "key"), ElementsAre()) << "on single scenes";
}

struct Choice {
    std::string name;
    std::vector<std::string> gpus;
    double max_error = 0;
    double max_cost = 0;
    std::string key;  ///< with its cost
};

class Chosen : public testing::TestWithParam<Choice> {};

TEST_P(Chosen, ByCycles) {
    const Family family = small_family();
    const std::string csv = csv_text(with_cycles(study(), costs()));
    const auto studied = read_studied(csv, "study.csv", family, GetParam().gpus).value();
    const auto key = choose(studied.at(default_key(family)),
                            {.max_error = GetParam().max_error, .max_cost = GetParam().max_cost}, "");
    ASSERT_TRUE(key);
    EXPECT_EQ(fmt::format("{}: {:.3g}", key_text(family, key->key), key->cost), GetParam().key);
}

INSTANTIATE_TEST_SUITE_P(
    Cost, Chosen,
    testing::Values(Choice{"AdditionsWhereNoChipIsNamed", {}, 0.05, 0, "power=rough: 60"},
                    Choice{"TheCheapestOfOneChip", {"navi21"}, 0.05, 0, "power=rough: 50"},
                    Choice{"AnotherChipChoosesOtherwise", {"vega10"}, 0.05, 0, "default: 100"},
                    Choice{"NothingWithALoop", {"navi21"}, 1, 0, "power=wild: 40"},
                    Choice{"WithinCycles", {"navi21"}, 0, 60, "power=rough: 50"},
                    // 100 / 40 and 50 / 40 on one, 100 / 50 and 140 / 50 on the other.
                    Choice{"TheWorstOfTwo", {"navi21", "vega10"}, 0.05, 0, "default: 2.5"}),
    [](const auto& choice) { return choice.param.name; });

TEST(StudyWithoutCycles, SaysHowToAddThem) {
    const auto help_of = [](const CsvTable& table, const std::string& path) {
        const auto studied = read_studied(csv_text(table), path, small_family(), {"polaris10"});
        return studied ? "" : to_text(studied.error().front());
    };
    EXPECT_EQ(help_of(study(), "mine.csv"),
              "mine.csv:1: error: holds no cycles of polaris10\n"
              "  help: add them: gobo cost small --study mine.csv --gpu polaris10 > study.csv, and choose by "
              "--study "
              "study.csv\n");
    EXPECT_EQ(
        help_of(with_cycles(study(), costs()), "data/study/small.csv"),
        "data/study/small.csv:1: error: holds no cycles of polaris10\n"
        "  help: it has those of navi21, vega10; add others: gobo library -o library, then gobo cost small "
        "--study library/data/study/small.csv --gpu polaris10 > study.csv, and choose by --study "
        "study.csv\n");
}

}  // namespace
}  // namespace gobo::cost
