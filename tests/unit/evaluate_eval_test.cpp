// The input file of `gobo eval` and what it prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "evaluate_support.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/eval_report.hpp"

namespace gobo::evaluate {
namespace {

constexpr const char* kDeclarations = R"(
struct Light { vec4 position; float power; };
layout(std140) uniform Lights { int count; Light lights[2]; mat2 turn; bool on; };
layout(binding = 3) uniform sampler2D tex;
)";

struct Case {
    const char* name;
    const char* file;
    const char* expected;  ///< all messages
};

const Case kCases[] = {
    {"no_toml", "stage = \n",
     "point.toml:1:9: error: Error while parsing key-value pair: expected value, saw '\\n'\n"
     "    stage = \n            ^\n"},
    {"unknown_stage", "stage = \"geometry\"\n",
     "point.toml:1:9: error: 'stage' is neither \"vertex\" nor \"fragment\"\n"
     "    stage = \"geometry\"\n            ^\n"},
    {"unknown_section", "[input]\na = 1\n",
     "point.toml:1:2: error: 'input' means nothing here\n    [input]\n     ^\n"
     "  help: did you mean 'inputs'?\n"},
    {"no_number", "[inputs]\na = [1, \"x\"]\n",
     "point.toml:2:5: error: 'a' is not a number, a boolean or an array of these\n    a = [1, \"x\"]\n       "
     " ^\n"},
    {"unknown_names", "[inputs]\nd = 1\n[uniforms]\n\"Lights.lights[0].pover\" = 2\n[samplers]\nmap = 1\n",
     "point.toml:2:1: error: the stage has no input 'd'\n    d = 1\n    ^\n"
     "  help: did you mean 'a'?\n"
     "point.toml:4:1: error: the stage has no uniform 'Lights.lights[0].pover'\n"
     "    \"Lights.lights[0].pover\" = 2\n    ^\n  help: did you mean 'Lights.lights[0].power'?\n"
     "point.toml:6:1: error: the stage has no sampler 'map'\n    map = 1\n    ^\n"},
    {"wrong_counts", "[inputs]\na = [1, 2, 3]\n[samplers]\ntex = []\n",
     "point.toml:2:1: error: 'a' is a vec4: it takes 4 numbers, not 3\n    a = [1, 2, 3]\n    ^\n"
     "point.toml:4:1: error: 'tex' takes one to four numbers\n    tex = []\n    ^\n"},
    {"unknown_member", "[samplers]\ntex = { colour = [1, 1, 1] }\n",
     "point.toml:2:9: error: a sampler has no 'colour'\n    tex = { colour = [1, 1, 1] }\n            ^\n"
     "  help: did you mean 'color'?\n"},
    {"no_size", "[samplers]\ntex = { size = [2, 1.5], depths = [1, 1] }\n",
     "point.toml:2:9: error: 'tex.size' takes the numbers of columns, rows and, of an array, layers\n"
     "    tex = { size = [2, 1.5], depths = [1, 1] }\n            ^\n"},
    {"too_few_depths", "[samplers]\ntex = { size = [2, 2], depths = [1, 1] }\n",
     "point.toml:2:24: error: 'tex' has 2 depths where its size asks for 4\n"
     "    tex = { size = [2, 2], depths = [1, 1] }\n                           ^\n"},
};

class EvalFile : public ::testing::TestWithParam<Case> {};

TEST_P(EvalFile, HasItsFaultsNamed) {
    const Program program =
        fragment_of("r = a + b + c + texture(tex, a.xy) * lights[1].power;", kDeclarations);
    const Result<EvalInputs> inputs = read_eval_inputs(GetParam().file, "point.toml");
    if (!inputs) {
        EXPECT_EQ(to_text(inputs.error()), GetParam().expected);
        return;
    }
    const Result<Invocations> invocations = invocations_of(*inputs, program);
    ASSERT_FALSE(invocations);
    EXPECT_EQ(to_text(invocations.error()), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Faults, EvalFile, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

constexpr const char* kFile = R"(stage = "fragment"
[inputs]
a = [0.1, 2, 3, 4]
[uniforms]
Lights.count = 2
"Lights.lights[1].power" = 0.5
"Lights.turn" = [[0, 1], [-1, 0]]
"Lights.on" = true
[samplers]
tex = [0.25, 0.5]
)";

EvalReport report_of(const Program& program, bool with_trace) {
    const Result<EvalInputs> inputs = read_eval_inputs(kFile, "point.toml");
    EXPECT_TRUE(inputs) << to_text(inputs.error());
    const Result<Invocations> invocations = invocations_of(*inputs, program);
    EXPECT_TRUE(invocations) << to_text(invocations.error());
    Result<EvalReport> report = evaluate_once(program, *invocations, {with_trace, {}, 0});
    EXPECT_TRUE(report) << to_text(report.error());
    return *report;
}

TEST(EvalReport, ShowsBothArithmeticsAndTheCounts) {
    const Program program = fragment_of(
        "r = vec4(turn * a.xy, lights[count - 1].power, on ? texture(tex, a.xy).y : 0.0);", kDeclarations);
    EXPECT_EQ(
        to_text(report_of(program, false), {}),
        "r (vec4)\n"
        "  fp32        -2                       0.100000001              0.5                      0.5\n"
        "  fp64        -2                       0.10000000000000001      0.5                      0.5\n"
        "  difference  0                        1.5e-09                  0                        0\n"
        "operations: add 2, mul 4, integer 1, compare 1, move 12, load 17, store 5, branch 1, image 1\n");
}

TEST(EvalReport, TracesUnderTheSourceLines) {
    const Program program = fragment_of("r = vec4(a.x * 2.0);\nr.y = -1.0;", kDeclarations);
    const std::string text = to_text(report_of(program, true), [](const Place& place) {
        return "  source " + std::to_string(place.line);
    });
    EXPECT_THAT(text,
                ::testing::StartsWith("test.glsl:12: source 12\n"
                                      "    Load -> a.x=0.1\n"
                                      "    FMul a.x=0.1, 2 -> 0.2\n"
                                      "    CompositeConstruct 0.2, 0.2, 0.2, 0.2 -> (0.2, 0.2, 0.2, 0.2)\n"
                                      "    Store -> r=(0.2, 0.2, 0.2, 0.2)\n"
                                      "test.glsl:13: source 13\n"
                                      "    Store -> r.y=-1\n\n"
                                      "r (vec4)\n"));
}

TEST(EvalReport, IsJsonToo) {
    const Program program =
        fragment_of("r = vec4(a.x / 0.0, sqrt(-a.y), 1.0, 2.0);\nif (a.z > 1.0) discard;", kDeclarations);
    EXPECT_EQ(
        to_json(report_of(program, false)).dump(),
        R"({"outputs":[{"name":"r","type":"vec4","fp32":["inf","nan",1.0,2.0],"fp64":["inf","nan",1.0,2.0],)"
        R"("difference":[0.0,0.0,0.0,0.0]}],"discarded":{"fp32":true,"fp64":true},)"
        R"("counts":{"add":1,"div":1,"sqrt":1,"compare":1,"move":4,"load":3,"store":4,"branch":1}})");
}

TEST(EvalReport, InputsLeftOutAreNoted) {
    const Program program = fragment_of("r = a + b;", kDeclarations);
    const Result<EvalInputs> inputs = read_eval_inputs("[inputs]\na = [1, 2, 3, 4]\n", "point.toml");
    ASSERT_TRUE(inputs);
    EXPECT_EQ(to_text(inputs_left_out(*inputs, program)),
              "gobo: note: the input 'b' (vec4) is not given and is 0\n"
              "gobo: note: the input 'c' (vec4) is not given and is 0\n");
}

}  // namespace
}  // namespace gobo::evaluate
