// What is computed from specialisation constants, operation by operation, against SPIRV-Tools' own folding.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include "spirv/constants.hpp"
#include "spirv/transform.hpp"

namespace gobo {
namespace {

using spirv::Constant;
using spirv::Constants;
using spirv::Id;
using testing::ElementsAreArray;

struct Row {
    const char* name;
    const char* operation;               ///< type, opcode and operands
    std::vector<std::uint64_t> value{};  ///< by component; empty where it has none
};

/// For messages of failed tests.
void PrintTo(const Row& row, std::ostream* stream) {
    *stream << row.name;
}

/// %a is 7, %b -3, %u 7 and %v 4294967293 without a sign, %yes and %no are booleans; all can be chosen.
constexpr const char* kBefore = R"(
OpCapability Shader
OpCapability Int64
OpMemoryModel Logical GLSL450
OpEntryPoint GLCompute %main "main"
OpExecutionMode %main LocalSize 1 1 1
OpDecorate %a SpecId 0
OpDecorate %b SpecId 1
OpDecorate %u SpecId 2
OpDecorate %v SpecId 3
OpDecorate %yes SpecId 4
OpDecorate %no SpecId 5
OpDecorate %wide SpecId 6
%void = OpTypeVoid
%function = OpTypeFunction %void
%bool = OpTypeBool
%int = OpTypeInt 32 1
%uint = OpTypeInt 32 0
%long = OpTypeInt 64 1
%ivec2 = OpTypeVector %int 2
%ivec3 = OpTypeVector %int 3
%bvec2 = OpTypeVector %bool 2
%two = OpConstant %uint 2
%pair = OpTypeArray %int %two
%struct = OpTypeStruct %ivec2 %pair
%zero = OpConstant %int 0
%one = OpConstant %int 1
%three = OpConstant %int 3
%thirty_two = OpConstant %int 32
%minus_one = OpConstant %int -1
%least = OpConstant %int -2147483648
%a = OpSpecConstant %int 7
%b = OpSpecConstant %int -3
%u = OpSpecConstant %uint 7
%v = OpSpecConstant %uint 4294967293
%wide = OpSpecConstant %long 4294967303
%yes = OpSpecConstantTrue %bool
%no = OpSpecConstantFalse %bool
%null = OpConstantNull %ivec2
%ab = OpSpecConstantComposite %ivec2 %a %b
%yes_no = OpSpecConstantComposite %bvec2 %yes %no
%elements = OpSpecConstantComposite %pair %b %a
%whole = OpSpecConstantComposite %struct %ab %elements
%inner = OpSpecConstantOp %pair CompositeExtract %whole 1
)";
constexpr const char* kBehind = R"(
%main = OpFunction %void None %function
%label = OpLabel
OpReturn
OpFunctionEnd
)";

constexpr std::uint64_t kMinus3 = 4294967293;
constexpr std::uint64_t kMinus7 = 4294967289;

const Row rows[] = {
    {"SConvert", "%long SConvert %b", {18446744073709551613U}},
    {"SConvert_narrower", "%int SConvert %wide", {7}},
    {"UConvert", "%uint UConvert %wide", {7}},
    {"SNegate", "%int SNegate %a", {kMinus7}},
    {"SNegate_of_the_least", "%int SNegate %least", {2147483648}},
    {"Not", "%int Not %a", {4294967288}},
    {"IAdd", "%int IAdd %a %b", {4}},
    {"IAdd_wraps", "%uint IAdd %v %u", {4}},
    {"IAdd_of_vectors", "%ivec2 IAdd %ab %ab", {14, 4294967290}},
    {"IAdd_of_64_bits", "%long IAdd %wide %wide", {8589934606}},
    {"ISub", "%int ISub %b %a", {4294967286}},
    {"IMul", "%int IMul %a %b", {4294967275}},
    {"IMul_wraps", "%uint IMul %v %v", {9}},
    {"UDiv", "%uint UDiv %v %u", {613566756}},
    {"SDiv", "%int SDiv %a %b", {4294967294}},
    {"SDiv_of_the_least", "%int SDiv %least %minus_one", {2147483648}},
    {"SDiv_by_zero", "%int SDiv %a %zero"},
    {"UDiv_by_zero", "%int UDiv %a %zero"},
    {"UMod", "%uint UMod %v %u", {1}},
    {"UMod_by_zero", "%int UMod %a %zero"},
    {"SRem", "%int SRem %a %b", {1}},
    {"SRem_of_negatives", "%int SRem %b %a", {kMinus3}},
    {"SRem_by_minus_one", "%int SRem %least %minus_one", {0}},
    {"SRem_by_zero", "%int SRem %a %zero"},
    {"SMod", "%int SMod %a %b", {4294967294}},
    {"SMod_of_negatives", "%int SMod %b %a", {4}},
    {"SMod_by_zero", "%int SMod %a %zero"},
    {"ShiftLeftLogical", "%int ShiftLeftLogical %a %three", {56}},
    {"ShiftLeftLogical_too_far", "%int ShiftLeftLogical %a %thirty_two"},
    {"ShiftRightLogical", "%int ShiftRightLogical %b %one", {2147483646}},
    {"ShiftRightLogical_too_far", "%int ShiftRightLogical %a %thirty_two"},
    {"ShiftRightArithmetic", "%int ShiftRightArithmetic %b %one", {4294967294}},
    {"ShiftRightArithmetic_too_far", "%int ShiftRightArithmetic %a %minus_one"},
    {"BitwiseOr", "%int BitwiseOr %a %thirty_two", {39}},
    {"BitwiseAnd", "%int BitwiseAnd %a %b", {5}},
    {"BitwiseXor", "%int BitwiseXor %a %one", {6}},
    {"LogicalOr", "%bool LogicalOr %yes %no", {1}},
    {"LogicalAnd", "%bool LogicalAnd %yes %no", {0}},
    {"LogicalNot", "%bool LogicalNot %no", {1}},
    {"LogicalNot_of_a_vector", "%bvec2 LogicalNot %yes_no", {0, 1}},
    {"LogicalEqual", "%bool LogicalEqual %yes %no", {0}},
    {"LogicalNotEqual", "%bool LogicalNotEqual %yes %no", {1}},
    {"IEqual", "%bool IEqual %a %u", {1}},
    {"INotEqual", "%bool INotEqual %a %u", {0}},
    {"UGreaterThan", "%bool UGreaterThan %b %a", {1}},
    {"SGreaterThan", "%bool SGreaterThan %b %a", {0}},
    {"UGreaterThanEqual", "%bool UGreaterThanEqual %u %a", {1}},
    {"SGreaterThanEqual", "%bool SGreaterThanEqual %b %a", {0}},
    {"ULessThan", "%bool ULessThan %b %a", {0}},
    {"SLessThan", "%bool SLessThan %b %a", {1}},
    {"ULessThanEqual", "%bool ULessThanEqual %u %a", {1}},
    {"SLessThanEqual", "%bool SLessThanEqual %a %b", {0}},
    {"Select", "%int Select %yes %a %b", {7}},
    {"Select_the_other", "%int Select %no %a %b", {kMinus3}},
    {"Select_of_vectors", "%ivec2 Select %yes_no %ab %null", {7, 0}},
    {"CompositeExtract", "%int CompositeExtract %ab 1", {kMinus3}},
    {"CompositeExtract_of_a_struct", "%int CompositeExtract %whole 0 0", {7}},
    {"CompositeExtract_of_an_array", "%int CompositeExtract %whole 1 1", {7}},
    {"CompositeExtract_twice", "%int CompositeExtract %inner 0", {kMinus3}},
    {"CompositeInsert", "%ivec2 CompositeInsert %one %ab 1", {7, 1}},
    {"VectorShuffle", "%ivec3 VectorShuffle %ab %null 1 0 2", {kMinus3, 7, 0}},
};

class Computed : public ::testing::TestWithParam<Row> {};

/// The value of the last constant of a module; empty where it has none.
std::vector<std::uint64_t> last_value(const spirv::Words& words,
                                      std::map<std::uint32_t, std::uint32_t> chosen = {}) {
    const auto module = spirv::read_module(words).value();
    Constants constants(module, std::move(chosen));
    Id last = Id::none;
    for (const spirv::Instruction& instruction : module.instructions) {
        constants.add(instruction);
        if (module.name(instruction.result) == "result") last = instruction.result;
    }
    const std::optional<Constant> value = constants.value(last);
    if (!value) return {};
    return {value->bits.begin(), value->bits.begin() + value->count};
}

spirv::Words assembled(const std::string& operation, spv_target_env environment) {
    spvtools::SpirvTools tools(environment);
    std::string problem;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { problem += message; });
    std::string text = fmt::format("{}%result = OpSpecConstantOp {}{}", kBefore, operation, kBehind);
    text.insert(text.find("OpDecorate"), "OpName %result \"result\"\n");
    spirv::Words words;
    EXPECT_TRUE(tools.Assemble(text, &words)) << problem;
    EXPECT_TRUE(tools.Validate(words)) << problem;
    return words;
}

TEST_P(Computed, HasTheValueThatItShould) {
    const std::string operation = GetParam().operation;
    // UConvert is a shader's from SPIR-V 1.4 on.
    const spirv::Words words =
        assembled(operation, operation.find("UConvert") != std::string::npos ? SPV_ENV_UNIVERSAL_1_4
                                                                             : SPV_ENV_UNIVERSAL_1_0);
    EXPECT_THAT(last_value(words), ElementsAreArray(GetParam().value));
}

TEST_P(Computed, IsWhatSpirvToolsMakesOfIt) {
    const std::string operation = GetParam().operation;
    if (GetParam().value.empty()) return;  // it takes 0 for what SPIR-V leaves undefined
    const spirv::Words words = assembled(operation, SPV_ENV_UNIVERSAL_1_4);
    const spirv::Words frozen = spirv::specialized(words, {}).value();
    EXPECT_THAT(last_value(frozen), ElementsAreArray(GetParam().value));
}

INSTANTIATE_TEST_SUITE_P(Operations, Computed, ::testing::ValuesIn(rows),
                         [](const auto& row) { return row.param.name; });

TEST(ChosenConstants, ReplaceDefaults) {
    const spirv::Words words = assembled("%int IMul %a %b", SPV_ENV_UNIVERSAL_1_0);
    EXPECT_THAT(last_value(words, {{0, 5}, {1, 4}}), ElementsAreArray({20U}));
    const spirv::Words condition = assembled("%bool LogicalAnd %yes %no", SPV_ENV_UNIVERSAL_1_0);
    EXPECT_THAT(last_value(condition, {{5, 1}}), ElementsAreArray({1U}));
}

}  // namespace
}  // namespace gobo
