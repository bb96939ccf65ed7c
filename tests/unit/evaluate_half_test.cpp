// What is mediump or lowp, as 16-bit floats: also in modules of other compilers than glslang, which states
// RelaxedPrecision of loads and variables wherever a function has it.
#include <gtest/gtest.h>

#include "evaluate_support.hpp"
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

INSTANTIATE_TEST_SUITE_P(Rows, RelaxedFunctions, ::testing::ValuesIn(kFunctions),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace gobo::evaluate
