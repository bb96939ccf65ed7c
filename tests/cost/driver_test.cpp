// Drivers in processes of their own, and where they are found. Where Mesa's is installed, its figures of lit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "compose/compose.hpp"
#include "core/text.hpp"
#include "cost_support.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/cost/stage_cost.hpp"

namespace gobo::cost {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Pipeline pipeline_named(const std::string& name) {
    return pipeline_of({"", kVertex,
                        fmt::format("#version 450\nout vec4 {0};\nvoid main() {{ {0} = vec4(1); }}\n", name),
                        ""})
        .value();
}

std::string text_of(const CompiledPipeline& pipeline) {
    return pipeline ? fmt::format(
                          "{} cycles",
                          cost_of(pipeline->front(), chips_named({"navi21"}).value().front(), false).cycles)
                    : pipeline.error();
}

TEST(FakeDriver, CostsNobodyElseTheirFigures) {
    const std::vector<Pipeline> pipelines = {pipeline_named("fine"),       pipeline_named("abort_here"),
                                             pipeline_named("also_fine"),  pipeline_named("hang_here"),
                                             pipeline_named("exit_here"),  pipeline_named("refuse_here"),
                                             pipeline_named("fault_here"), pipeline_named("fine_again")};
    const auto answers = compile(chips_of({"navi21", "vega10"}), pipelines,
                                 {.driver = GOBO_FAKE_DRIVER, .jobs = 3, .time_limit = 4});
    ASSERT_EQ(answers.size(), 2U);
    for (const auto& answer : answers) {
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->driver, "fake 1.0");
        std::vector<std::string> texts;
        for (const CompiledPipeline& pipeline : answer->pipelines) texts.push_back(text_of(pipeline));
        EXPECT_THAT(texts, ElementsAre("42 cycles", "crashed with signal 6 (Aborted)", "42 cycles",
                                       "gave no answer within 4 s", "ended with status 0",
                                       "answered vkCreateShaderModule with -2",
                                       "crashed with signal 11 (Segmentation fault); before that it printed: "
                                       "fake: of something else",
                                       "42 cycles"));
    }
}

struct BadDriver {
    std::string name;
    std::string chip;
    std::string driver;
    std::string message;
    std::string help = "mesa-vulkan-drivers";
};

class BadDrivers : public testing::TestWithParam<BadDriver> {};

TEST_P(BadDrivers, AreErrorsThatSayWhatToInstall) {
    const auto answers =
        compile(chips_of({GetParam().chip}), {pipeline_named("fine")}, {.driver = GetParam().driver});
    ASSERT_FALSE(answers.front());
    EXPECT_THAT(answers.front().error().front().message, HasSubstr(GetParam().message));
    EXPECT_THAT(answers.front().error().front().help, HasSubstr(GetParam().help));
    EXPECT_EQ(exit_status(answers.front().error()), 3);
}

INSTANTIATE_TEST_SUITE_P(
    Cost, BadDrivers,
    testing::Values(BadDriver{"KnowsNoSuchChip", "tahiti", GOBO_FAKE_DRIVER,
                              "tahiti: the driver crashed with signal 6 (Aborted): fake: unknown chip",
                              "a newer mesa-vulkan-drivers may know it"},
                    BadDriver{"KnowsTheChipByAnotherName", "gfx1100", GOBO_FAKE_DRIVER,
                              "gfx1100: the driver crashed with signal 6 (Aborted): fake: unknown chip",
                              "newer drivers know it as navi31: write --gpu navi31"},
                    BadDriver{"CrashesAsItIsLoaded", "hawaii", GOBO_FAKE_DRIVER,
                              "hawaii: the driver crashed with signal 6 (Aborted)",
                              "'gobo cost --gpu list' says of which chips this driver has figures"},
                    BadDriver{"HasNoDevice", "pitcairn", GOBO_FAKE_DRIVER, "has no device", "--gpu list"},
                    BadDriver{"TellsNothing", "bonaire", GOBO_FAKE_DRIVER,
                              "fake 1.0 tells nothing of compiled shaders", "libvulkan_radeon.so"},
                    BadDriver{"IsNotThere", "navi21", "libno_such_driver.so",
                              "navi21: cannot load the Vulkan driver: libno_such"},
                    BadDriver{"IsNoDriver", "navi21", "libm.so.6", "libm.so.6 is no Vulkan driver"}),
    [](const auto& bad) { return bad.param.name; });

using Files = std::map<std::string, std::string, std::less<>>;

struct Place {
    std::string name;
    std::string where;
    Maker maker;
    DriverPlace place;
};

class Places : public testing::TestWithParam<Place> {};

TEST_P(Places, AreFound) {
    const MemoryFileSystem disk(Files{{"debian13/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/libvulkan_nouveau.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/libnouveau_noop_drm_shim.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2", ""},
                                      {"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""}});
    const auto place = find_driver(disk, GetParam().where, GetParam().maker);
    ASSERT_TRUE(place);
    EXPECT_EQ(*place, GetParam().place);
}

const std::string kUnpacked = "debian13/usr/lib/x86_64-linux-gnu";

INSTANTIATE_TEST_SUITE_P(
    Cost, Places,
    testing::Values(Place{"Installed", "", Maker::amd, {"libvulkan_radeon.so"}},
                    Place{"InstalledWithoutAGpu",
                          "",
                          Maker::nvidia,
                          {"libvulkan_nouveau.so", "", "", "libnouveau_noop_drm_shim.so"}},
                    Place{"ALibrary", "./lib/libvulkan_radeon.so", Maker::amd, {"./lib/libvulkan_radeon.so"}},
                    Place{
                        "PackagesWithALibc",
                        "debian13",
                        Maker::amd,
                        {kUnpacked + "/libvulkan_radeon.so", kUnpacked, kUnpacked + "/ld-linux-x86-64.so.2"}},
                    Place{"PackagesOfBoth",
                          "debian13",
                          Maker::nvidia,
                          {kUnpacked + "/libvulkan_nouveau.so", kUnpacked,
                           kUnpacked + "/ld-linux-x86-64.so.2", kUnpacked + "/libnouveau_noop_drm_shim.so"}},
                    Place{"PackagesWithoutALibc",
                          "backports",
                          Maker::amd,
                          {"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so",
                           "backports/usr/lib/x86_64-linux-gnu"}}),
    [](const auto& place) { return place.param.name; });

TEST(Places, OfNoDriverAreErrors) {
    const MemoryFileSystem disk(Files{{"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""}});
    EXPECT_EQ(to_text(find_driver(disk, "backports", Maker::nvidia).error().front()),
              "gobo: error: backports holds no libvulkan_nouveau.so, such as "
              "backports/usr/lib/x86_64-linux-gnu/libvulkan_nouveau.so\n"
              "  help: fetch Mesa's drivers into a folder with tools/fetch_mesa.sh (installed: "
              "share/gobo/tools)\n");
}

TEST(Chips, AreNamedInAnyCaseAndOnce) {
    const auto chips = chips_of({"NAVI21", "navi21", "Vega10"});
    ASSERT_EQ(chips.size(), 2U);
    EXPECT_EQ(chips[0].name, "navi21");
    EXPECT_EQ(to_text(chips_named({"navi-21"}).error().front()),
              "gobo: error: unknown GPU 'navi-21'\n  help: did you mean 'navi21'?\n");
}

/// Figures of lit on two chips by Mesa's own driver, where it is there.
class Mesa : public testing::Test {
  protected:
    static std::vector<Pipeline> pipelines_of(const std::vector<std::string>& texts,
                                              Dialect dialect = Dialect::own) {
        const DiskFileSystem disk;
        const Family family =
            read_family(disk.read(GOBO_SOURCE_DIR "/templates/lit.toml").value(), "templates/lit.toml")
                .value();
        SearchPath search = shipped_pieces();
        search.add(disk, GOBO_SOURCE_DIR "/templates", "templates/", false);
        std::vector<Pipeline> pipelines;
        for (const std::string& text : texts) {
            const Key key = canonical(family, parse_key(family, text).value(), "450");
            const Composition composition = compose(family, {key}, search, dialect).value();
            pipelines.push_back(pipeline_of(family, composition).value());
        }
        return pipelines;
    }

    /// By chip and pipeline the stages.
    static std::vector<std::vector<std::vector<StageCost>>> costs_of(const std::vector<Pipeline>& pipelines,
                                                                     int jobs) {
        std::vector<std::vector<std::vector<StageCost>>> all;
        const auto chips = chips_of({"navi21", "polaris10"});
        const auto answers = compile(chips, pipelines, {.jobs = jobs});
        for (std::size_t i = 0; i < chips.size(); ++i) {
            auto& chip = all.emplace_back();
            for (const CompiledPipeline& pipeline : answers[i].value().pipelines) {
                auto& stages = chip.emplace_back();
                for (const CompiledStage& stage : pipeline.value())
                    stages.push_back(cost_of(stage, chips[i], false));
            }
        }
        return all;
    }

    void SetUp() override {
        const auto answers = compile(chips_of({"navi21"}), {}, {});
        // Mesa's driver for AMD's chips is optional: tools/setup.sh installs it, other systems may lack it.
        if (!answers.front()) GTEST_SKIP() << "SKIPPED: " << to_text(answers.front().error().front());
    }
};

TEST_F(Mesa, CountsWhatItPrints) {
    for (const auto& chip : costs_of(pipelines_of({"point=2 specular=blinn"}), 1))
        for (const StageCost& stage : chip.front()) {
            std::uint64_t sum = 0;
            for (const std::uint64_t count : stage.kinds) sum += count;
            EXPECT_EQ(sum, stage.instructions) << stage.assembly;
            EXPECT_GT(stage.cycles, 0U);
            EXPECT_GT(stage.vector_registers, 0U);
            EXPECT_GT(stage.occupancy, 0U);
            EXPECT_GT(stage.code_bytes, 0U);
        }
}

TEST_F(Mesa, ChargesMoreForMore) {
    const std::vector<std::string> keys = {"default", "point=1", "point=2", "point=2 specular=blinn",
                                           "point=2 specular=blinn fog=exponential"};
    for (const auto& chip : costs_of(pipelines_of(keys), 2))
        for (std::size_t i = 1; i < chip.size(); ++i) {
            EXPECT_GT(chip[i][1].cycles, chip[i - 1][1].cycles) << keys[i];
            EXPECT_GT(chip[i][1].instructions, chip[i - 1][1].instructions) << keys[i];
        }
}

TEST_F(Mesa, ChargesComputeStages) {
    std::vector<Pipeline> pipelines;
    for (const char* value : {"x", "sin(x)", "sin(x) + shared_values[63 - gl_LocalInvocationIndex]"})
        pipelines.push_back(
            pipeline_of({"", "", "", "",
                         fmt::format("#version 450\nlayout(local_size_x = 64) in;\nuniform float gain;\n"
                                     "layout(std430, binding = 0) buffer Values {{ float values[]; }};\n"
                                     "shared float shared_values[64];\n"
                                     "void main() {{\n  float x = gain * values[gl_GlobalInvocationID.x];\n"
                                     "  shared_values[gl_LocalInvocationIndex] = x;\n  barrier();\n"
                                     "  values[gl_GlobalInvocationID.x] = {};\n}}\n",
                                     value)})
                .value());
    for (const auto& chip : costs_of(pipelines, 2))
        for (std::size_t i = 0; i < chip.size(); ++i) {
            ASSERT_EQ(chip[i].size(), 1U);
            EXPECT_EQ(chip[i][0].stage, "compute");
            EXPECT_GT(chip[i][0].instructions, i == 0 ? 0 : chip[i - 1][0].instructions);
            EXPECT_GT(chip[i][0].cycles, i == 0 ? 0 : chip[i - 1][0].cycles);
        }
}

TEST_F(Mesa, AnswersTheSameEachTime) {
    std::vector<std::string> keys;
    for (const char* fog : {"none", "linear", "exponential"})
        for (int point = 0; point < 6; ++point) keys.push_back(fmt::format("fog={} point={}", fog, point));
    const auto pipelines = pipelines_of(keys);
    EXPECT_EQ(costs_of(pipelines, 1), costs_of(pipelines, 2));
}

/// Other places, and counts as constants of the pipeline: it is the same work.
TEST_F(Mesa, ChargesTheSameByTheDialectVulkan) {
    const std::vector<std::string> keys = {"default", "point=1", "point=3 specular=blinn",
                                           "directional=1 directional_shadows=1 fog=linear"};
    EXPECT_EQ(costs_of(pipelines_of(keys), 2), costs_of(pipelines_of(keys, Dialect::vulkan), 2));
}

/// Uniforms outside blocks cost what the same uniforms cost in a block that the source declares.
TEST_F(Mesa, TakesPlainUniformsAsABlock) {
    const std::string use =
        "\nout vec4 color;\nvoid main() {\n  color = tint * levels[2] + turn[1].xyzz;\n"
        "  for (int i = 0; i < count; ++i) color *= color;\n}\n";
    const std::string members = "vec4 tint; float levels[3]; mat3 turn; int count;";
    std::string loose;
    for (const std::string& member : split(members, ';')) loose += "uniform " + member + "; ";
    const auto stages = costs_of(
        {pipeline_of({"", kVertex, "#version 450\n" + loose + use, ""}).value(),
         pipeline_of(
             {"", kVertex, "#version 450\nlayout(std140) uniform Settings { " + members + " };" + use, ""})
             .value()},
        1);
    for (const auto& chip : stages) EXPECT_EQ(chip[0], chip[1]);
}

TEST_F(Mesa, SaysThatItDoesNotKnowAChip) {
    const auto answers = compile({Chip{"navi99", "", ""}}, {}, {});
    EXPECT_THAT(answers.front().error().front().message,
                HasSubstr("navi99: the driver crashed with signal 6"));
}

}  // namespace
}  // namespace gobo::cost
