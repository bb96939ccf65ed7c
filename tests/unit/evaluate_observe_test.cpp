// Counts, places, traces and observers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"
#include "lab/evaluate/eval_report.hpp"

namespace gobo::evaluate {
namespace {

using ::testing::ElementsAre;

/// "add 3, mul 4" of one invocation: the kinds that occur.
std::string counts_of(const Program& program,
                      std::map<std::string, std::vector<double>, std::less<>> values) {
    Invocations invocations;
    invocations.values = std::move(values);
    Options options;
    options.count = true;
    const Result<Outputs> outputs = run<float>(program, invocations, options);
    EXPECT_TRUE(outputs);
    if (!outputs) return {};
    std::string text;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        if (outputs->counts[0][kind] == 0) continue;
        if (!text.empty()) text += ", ";
        text += std::string(kKindNames[kind]) + " " + std::to_string(outputs->counts[0][kind]);
    }
    return text;
}

struct Case {
    const char* name;
    const char* body;  ///< with a = (2, 3, 4, 5)
    const char* expected;
};

const Case kCases[] = {
    {"components_count", "r = a * b + c;", "add 4, mul 4, load 12, store 4"},
    {"matrix_times_vector", "r.xyz = mat3(1.0) * a.xyz;", "add 6, mul 9, move 6, load 4, store 3"},
    {"functions_by_kind", "r = vec4(pow(a.x, a.y), sqrt(a.z), inversesqrt(a.w), exp2(a.x));",
     "sqrt 1, inverse_sqrt 1, pow 1, exp 1, move 4, load 5, store 4"},
    {"dot_and_length", "r = vec4(dot(a, a), length(a.xyz), 0.0, 0.0);",
     "dot 4, geometric 3, move 7, load 12, store 4"},
    {"only_what_runs", "if (a.x > 5.0) r = sin(a); else r.x = cos(a.x);",
     "trig 1, compare 1, load 2, store 1, branch 1"},
    {"each_iteration", "r = vec4(0.0); for (int i = 0; i < 3; ++i) r.x += a.x;",
     "add 3, integer 3, compare 4, load 13, store 11, branch 4"},
};

class Counting : public ::testing::TestWithParam<Case> {};

TEST_P(Counting, IsExact) {
    EXPECT_EQ(counts_of(fragment_of(GetParam().body), {{"a", {2, 3, 4, 5}}}), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Counting, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Counting, IsOfEachInvocation) {
    const Program program = fragment_of("r = vec4(0.0); for (int i = 0; i < int(a.x); ++i) r.x += 1.0;");
    Invocations invocations;
    invocations.count = 70;
    invocations.values["a"].assign(280, 0.0);
    for (std::size_t i = 0; i < 70; ++i) invocations.values["a"][i] = static_cast<double>(i % 5);
    Options options;
    options.count = true;
    const Result<Outputs> outputs = run<double>(program, invocations, options);
    ASSERT_TRUE(outputs);
    for (std::size_t i = 0; i < 70; ++i)
        EXPECT_EQ(outputs->counts[i][static_cast<std::size_t>(Kind::add)], i % 5) << i;
}

TEST(Tracing, ShowsPlacesNamesAndValues) {
    const Program program = fragment_of("float t = a.x * 2.0;\nr = vec4(t, sqrt(lights[int(a.y)].xy), 1.0);",
                                        "layout(std140) uniform Lights { vec4 lights[2]; };");
    Invocations invocations;
    invocations.values = {{"a", {0.5, 1, 0, 0}}, {"Lights.lights[1]", {4, 9, 0, 0}}};
    Trace<float> trace;
    ASSERT_TRUE(run<float>(program, invocations, {}, &trace));
    EXPECT_EQ(to_text(trace.steps()),
              "test.glsl:8\n"
              "    Load -> a.x=0.5\n"
              "    FMul a.x=0.5, 2 -> 1\n"
              "    Store -> t=1\n"
              "test.glsl:9\n"
              "    Load -> t=1\n"
              "    Load -> a.y=1\n"
              "    ConvertFToS a.y=1 -> 1\n"
              "    AccessChain 1 -> Lights.lights[...]\n"
              "    Load -> Lights.lights[...]=(4, 9, 0, 0)\n"
              "    VectorShuffle Lights.lights[...]=(4, 9, 0, 0), Lights.lights[...]=(4, 9, 0, 0) -> (4, 9)\n"
              "    Sqrt (4, 9) -> (2, 3)\n"
              "    CompositeExtract 2 -> 2\n"
              "    CompositeExtract 3 -> 3\n"
              "    CompositeConstruct t=1, 2, 3, 1 -> (1, 2, 3, 1)\n"
              "    Store -> r=(1, 2, 3, 1)\n");
}

TEST(Tracing, FollowsOneInvocationOnly) {
    const Program program = fragment_of("if (a.x > 0.0) r = vec4(1.0);\nelse r = vec4(2.0);");
    Invocations invocations;
    invocations.count = 66;
    invocations.values["a"].assign(264, 0.0);
    invocations.values["a"][65] = 1;
    Trace<double> trace(65);
    ASSERT_TRUE(run<double>(program, invocations, {}, &trace));
    EXPECT_EQ(to_text(trace.steps()),
              "test.glsl:8\n"
              "    Load -> a.x=1\n"
              "    FOrdGreaterThan a.x=1, 0 -> 1\n"
              "    Store -> r=(1, 1, 1, 1)\n");
}

/// Divisions by zero, seen before they happen: how a numeric sanitizer looks at operations.
template <class T>
class DivisionsByZero final : public Observer<T> {
  public:
    void before(const Step<T>& step) override {
        if (step.name() != "FDiv") return;
        const Slice& divisor = step.info().operands[1];
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            for (std::uint32_t component = 0; component < divisor.count; ++component)
                if ((step.lanes >> lane & 1U) != 0 && step.value(divisor, component, lane) == 0)
                    found.push_back(step.place().file + ":" + std::to_string(step.place().line) +
                                    " invocation " + std::to_string(step.first_invocation + lane));
    }
    void clamped(const Step<T>& step, std::size_t, std::int64_t index, std::uint32_t extent) override {
        found.push_back(std::to_string(step.place().line) + ": " + std::to_string(index) + " of " +
                        std::to_string(extent));
    }
    std::vector<std::string> found;
};

TEST(Observing, SeesOperandsBeforeTheOperationAndActiveLanesOnly) {
    const Program program = fragment_of("r = vec4(0.0);\nif (a.x < 2.0)\n  r.x = 1.0 / a.y;");
    Invocations invocations;
    invocations.count = 3;
    invocations.values["a"] = {1, 3, 1, 0, 0, 5, 0, 0, 0, 0, 0, 0};
    DivisionsByZero<float> observer;
    ASSERT_TRUE(run<float>(program, invocations, {}, &observer));
    EXPECT_THAT(observer.found, ElementsAre("test.glsl:10 invocation 0"));
}

TEST(Observing, HearsOfIndicesThatAreClamped) {
    const Program program =
        fragment_of("float w[3] = float[3](1.0, 2.0, 3.0);\nr = vec4(w[int(a.x)]);\nr.x += a[int(b.x)];");
    Invocations invocations;
    invocations.values = {{"a", {5, 0, 0, 0}}, {"b", {-1, 0, 0, 0}}};
    DivisionsByZero<double> observer;
    ASSERT_TRUE(run<double>(program, invocations, {}, &observer));
    EXPECT_THAT(observer.found, ElementsAre("9: 5 of 3", "10: -1 of 4"));
}

TEST(Observing, ChangesNoResult) {
    const Program program =
        fragment_of("vec4 s = a; s = s.wzyx; s.xy += s.zw; r = normalize(s) * b[int(c.x)];");
    const std::map<std::string, std::vector<double>, std::less<>> values = {
        {"a", {1, 2, 3, 4}}, {"b", {5, 6, 7, 8}}, {"c", {2, 0, 0, 0}}};
    Invocations invocations;
    invocations.values = values;
    Trace<float> trace;
    const Result<Outputs> observed = run<float>(program, invocations, {}, &trace);
    ASSERT_TRUE(observed);
    EXPECT_EQ(observed->values.at("r"), output_of<float>(program, values));
}

}  // namespace
}  // namespace gobo::evaluate
