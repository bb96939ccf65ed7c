// What is mediump or lowp, as 16-bit floats: also in modules of other compilers than glslang, which states
// RelaxedPrecision of loads and variables wherever a function has it.
#include <gtest/gtest.h>

#include "evaluate_support.hpp"
#include "lab/evaluate/eval_report.hpp"
#include "spirv/module.hpp"

namespace gobo::evaluate {
namespace {

/// The module with RelaxedPrecision on every result of that opcode.
std::vector<std::uint32_t> relaxed(const std::vector<std::uint32_t>& words, spv::Op opcode) {
    const auto module = spirv::read_module(words);
    EXPECT_TRUE(module);
    std::vector<std::uint32_t> decorations;
    for (const spirv::Instruction& one : module->instructions)
        if (one.opcode == opcode)
            decorations.insert(decorations.end(),
                               {3U << 16U | spv::OpDecorate, static_cast<std::uint32_t>(one.result),
                                spv::DecorationRelaxedPrecision});
    // They stand ahead of the types.
    std::size_t at = 5;
    while ((words[at] & 0xffffU) != spv::OpTypeVoid) at += words[at] >> 16U;
    std::vector<std::uint32_t> result = words;
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(at), decorations.begin(), decorations.end());
    return result;
}

struct FunctionCase {
    const char* name;
    const char* function;
    const char* body;
    spv::Op relaxed;
};

void PrintTo(const FunctionCase& row, std::ostream* out) {
    *out << row.name;
}

const FunctionCase kFunctions[] = {
    {"returned_value", "float f(float x) { return x; }", "r = vec4(f(a.x));", spv::OpFunction},
    {"returned_vector", "vec4 f(vec4 x) { return x; }", "r = f(a);", spv::OpFunction},
    {"returned_on_some_path", "float f(float x) { if (x > 2.0) return 0.0; return x; }", "r = vec4(f(a.x));",
     spv::OpFunction},
    {"parameter_by_value", "float f(const float x) { return x; }", "r = vec4(f(a.x));",
     spv::OpFunctionParameter},
    {"parameter_that_is_written", "float f(float x) { x += 0.0; return x; }", "r = vec4(f(a.x));",
     spv::OpFunctionParameter},
    {"parameter_that_is_given_back", "void f(float x, out float y) { y = x; }",
     "float y; f(a.x, y); r = vec4(y);", spv::OpFunctionParameter},
};

class RelaxedFunctions : public ::testing::TestWithParam<FunctionCase> {};

TEST_P(RelaxedFunctions, RoundWhatPasses) {
    const FunctionCase& row = GetParam();
    const auto words =
        compile(ShaderStage::fragment,
                std::string("#version 450\nlayout(location = 0) in vec4 a;\nlayout(location = 0) out vec4 "
                            "r;\n") +
                    row.function + "\nvoid main() {\n" + row.body + "\n}\n");
    const auto value = [&](const std::vector<std::uint32_t>& module) {
        const Result<Program> program = decode(module);
        EXPECT_TRUE(program);
        Invocations invocations;
        const double fine = 1 + 0x1p-20;
        invocations.values = {{"a", {fine, fine, fine, fine}}};
        return run<float>(*program, invocations, {.is_half = true})->values.at("r")[0];
    };
    EXPECT_EQ(value(words), 1 + 0x1p-20);
    EXPECT_EQ(value(relaxed(words, row.relaxed)), 1);
}

TEST(TracingHalves, ShowsWhatAVariableHolds) {
    const auto words = relaxed(compile(ShaderStage::fragment,
                                       "#version 450\nlayout(location = 0) in vec4 a;\n"
                                       "layout(location = 0) out vec4 r;\n"
                                       "void main() { float t = a.x; r = vec4(t); }\n"),
                               spv::OpVariable);
    const Result<Program> program = decode(words);
    ASSERT_TRUE(program);
    Invocations invocations;
    invocations.values = {{"a", {2e5, 0, 0, 0}}};
    Trace<float> trace;
    ASSERT_TRUE(run<float>(*program, invocations, {.is_half = true}, &trace));
    const auto text = to_text(trace.steps());
    EXPECT_NE(text.find("Store -> t=inf\n"), std::string::npos) << text;
}

struct SmallCase {
    const char* name;
    double input;
    double gradual, flushed, kept;  ///< its square
};

void PrintTo(const SmallCase& row, std::ostream* out) {
    *out << row.name;
}

constexpr double kOdd = 1 + 0x1p-5;
const SmallCase kSmall[] = {
    {"normal", 0x1p-7 * kOdd, 0x1p-14 * kOdd* kOdd, 0x1p-14 * kOdd* kOdd, 0x1p-14 * kOdd* kOdd},
    {"denormal", 0x1p-8 * kOdd, 0x1p-16 * (kOdd * kOdd - 0x1p-10), 0, 0x1p-16 * kOdd* kOdd},
    {"least", 0x1p-12, 0x1p-24, 0, 0x1p-24},
    {"too_small", 0x1p-13, 0, 0, 0x1p-26},
    {"far_too_small", 0x1p-40 * kOdd, 0, 0, 0x1p-80 * kOdd* kOdd},
    {"negative", -0x1p-40, 0, 0, 0x1p-80},
};

class SmallNumbers : public ::testing::TestWithParam<SmallCase> {};

TEST_P(SmallNumbers, AreRoundedAsTheArithmeticSays) {
    const SmallCase& row = GetParam();
    const auto words = relaxed(compile(ShaderStage::fragment,
                                       "#version 450\nlayout(location = 0) in vec4 a;\n"
                                       "layout(location = 0) out vec4 r;\nvoid main() { r = a * a; }\n"),
                               spv::OpFMul);
    const Result<Program> program = decode(words);
    ASSERT_TRUE(program);
    Invocations invocations;
    invocations.count = 2;
    invocations.values = {{"a", {row.input, row.input, row.input, row.input}}};
    const auto squares = [&](Options options) {
        options.is_half = true;
        const auto outputs = run<float>(*program, invocations, options);
        return std::pair(outputs->values.at("r")[0], outputs->values.at("r")[1]);
    };
    using Pair = std::pair<double, double>;
    EXPECT_EQ(squares({}), Pair(row.gradual, row.gradual));
    EXPECT_EQ(squares({.flush_denormals = true}), Pair(row.flushed, row.flushed));
    const auto all = static_cast<std::uint32_t>(program->constants.size() + program->operations.size());
    const std::vector<std::uint32_t> one_of_two{0, all};
    EXPECT_EQ(squares({.loses_small = &one_of_two}), Pair(row.kept, row.gradual));
}

INSTANTIATE_TEST_SUITE_P(Rows, SmallNumbers, ::testing::ValuesIn(kSmall),
                         [](const auto& one) { return std::string(one.param.name); });
INSTANTIATE_TEST_SUITE_P(Rows, RelaxedFunctions, ::testing::ValuesIn(kFunctions),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace gobo::evaluate
