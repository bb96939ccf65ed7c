// Malformed modules are diagnostics, never crashes.
#include <gtest/gtest.h>

#include "reflect/reflect.hpp"
#include "reflect_compile.hpp"
#include "reflect_unused.hpp"

namespace gobo {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t magic = 0x07230203;

/// The header of a module, then the instructions' words.
Words module_of(const Words& instructions) {
    Words words = {magic, 0x00010000, 0, 100, 0};
    words.insert(words.end(), instructions.begin(), instructions.end());
    return words;
}

std::uint32_t op(spv::Op opcode, std::uint32_t words) {
    return (words << 16) | static_cast<std::uint32_t>(opcode);
}

struct Row {
    const char* name;
    Words words;
    const char* error;
};

/// For messages of failed tests.
void PrintTo(const Row& row, std::ostream* stream) {
    *stream << row.name;
}

const Row rows[] = {
    {"empty", {}, "gobo: error: malformed SPIR-V module at word 0: it is shorter than a header\n"},
    {"other_file",
     {1, 2, 3, 4, 5},
     "gobo: error: malformed SPIR-V module at word 0: it does not begin with SPIR-V's magic number\n"},
    {"no_words", module_of({0}),
     "gobo: error: malformed SPIR-V module at word 5: an instruction of no words\n"},
    {"cut_off", module_of({op(spv::Op::OpName, 4), 1, 0}),
     "gobo: error: malformed SPIR-V module at word 5: an instruction runs past the end\n"},
    {"few_operands", module_of({op(spv::Op::OpTypeInt, 2), 1}),
     "gobo: error: malformed SPIR-V module at word 5: an instruction lacks operands\n"},
    {"endless_string", module_of({op(spv::Op::OpName, 3), 1, 0x41414141}),
     "gobo: error: malformed SPIR-V module at word 5: a string without an end\n"},
    {"unknown_element", module_of({op(spv::Op::OpTypeRuntimeArray, 3), 1, 2}),
     "gobo: error: malformed SPIR-V module at word 5: a type made of an unknown type\n"},
    {"struct_of_itself", module_of({op(spv::Op::OpTypeStruct, 3), 1, 1}),
     "gobo: error: malformed SPIR-V module at word 5: a type made of an unknown type\n"},
    {"matrix_of_scalars",
     module_of({op(spv::Op::OpTypeFloat, 3), 1, 32, op(spv::Op::OpTypeMatrix, 4), 2, 1, 3}),
     "gobo: error: malformed SPIR-V module at word 8: a type made of the wrong type\n"},
    {"vector_of_five", module_of({op(spv::Op::OpTypeFloat, 3), 1, 32, op(spv::Op::OpTypeVector, 4), 2, 1, 5}),
     "gobo: error: malformed SPIR-V module at word 8: a vector or matrix of impossible size\n"},
    {"unknown_extent", module_of({op(spv::Op::OpTypeFloat, 3), 1, 32, op(spv::Op::OpTypeArray, 4), 2, 1, 9}),
     "gobo: error: malformed SPIR-V module at word 8: an array whose size is not an integer constant\n"},
    {"sized_by_itself", module_of({op(spv::Op::OpTypeFloat, 3), 1, 32, op(spv::Op::OpTypeArray, 4), 2, 1, 2}),
     "gobo: error: malformed SPIR-V module at word 8: an array whose size is not an integer constant\n"},
    {"extent_of_none",
     module_of({op(spv::Op::OpTypeInt, 4), 1, 32, 0, op(spv::Op::OpConstant, 4), 1, 2, 0,
                op(spv::Op::OpTypeArray, 4), 3, 1, 2}),
     "gobo: error: malformed SPIR-V module at word 13: an array of impossible size\n"},
    {"twice", module_of({op(spv::Op::OpTypeBool, 2), 1, op(spv::Op::OpTypeBool, 2), 1}),
     "gobo: error: malformed SPIR-V module at word 7: an id declared twice\n"},
    {"variable_of_no_pointer",
     module_of({op(spv::Op::OpTypeBool, 2), 1, op(spv::Op::OpVariable, 4), 1, 2, 1}),
     "gobo: error: malformed SPIR-V module at word 7: a variable whose type is not a pointer\n"},
    {"decoration_groups", module_of({op(spv::Op::OpGroupDecorate, 2), 1}),
     "gobo: error: malformed SPIR-V module at word 5: decoration groups are not supported\n"},
    {"no_entry_point", module_of({}), "gobo: error: the SPIR-V module has no entry point\n"},
    {"kernel", module_of({op(spv::Op::OpEntryPoint, 4), 6, 1, 0}),
     "gobo: error: the SPIR-V module is of an unknown kind of stage\n"},
    {"block_without_offsets",
     module_of({op(spv::Op::OpEntryPoint, 4),
                4,
                1,
                0,
                op(spv::Op::OpName, 3),
                3,
                'B',
                op(spv::Op::OpDecorate, 3),
                3,
                2 /* Block */,
                op(spv::Op::OpTypeBool, 2),
                2,
                op(spv::Op::OpTypeStruct, 3),
                3,
                2,
                op(spv::Op::OpTypePointer, 4),
                4,
                2 /* Uniform */,
                3,
                op(spv::Op::OpVariable, 4),
                4,
                5,
                2}),
     "gobo: error: block 'B' of the SPIR-V module has no layout\n"},
};

class Malformed : public ::testing::TestWithParam<Row> {};

TEST_P(Malformed, IsADiagnostic) {
    const Result<Interface> interface = reflect_stage(GetParam().words);
    ASSERT_FALSE(interface);
    EXPECT_EQ(to_text(interface.error().front()), GetParam().error);
    EXPECT_EQ(exit_status(interface.error()), 4);
}

INSTANTIATE_TEST_SUITE_P(Modules, Malformed, ::testing::ValuesIn(rows),
                         [](const auto& row) { return row.param.name; });

/// A module with something of everything.
Words rich_module() {
    return testing::compile(testing::Stage::fragment, R"(#version 450
struct Light { vec3 color; bool on; mat2x3 frame[2]; };
layout(std140) uniform Lights { layout(row_major) Light lights[2][3]; float last[4]; } all[2];
struct Surface { vec4 tint; float w[2]; };
uniform Surface surfaces[2];
uniform sampler2DArrayShadow maps[2];
layout(constant_id = 3) const int COUNT = 2;
in Ray { vec3 origin; float weights[COUNT]; } rays[2];
out vec4 color[2];
void main() { color[1] = surfaces[1].tint + texture(maps[1], vec4(1.0)) + all[0].lights[0][1].color.xyzz; }
)")
        .spirv;
}

/// Everything that reads a module; true where the module was accepted.
bool survives(const Words& words) {
    const Result<Interface> interface = reflect_stage(words);
    const bool readable = unused_variables(words).has_value();
    return interface.has_value() && readable && unite({*interface, *interface}).differing.empty();
}

TEST(RichModule, IsAcceptedWhole) {
    EXPECT_TRUE(survives(rich_module()));
}

TEST(RichModule, CutAnywhereInItsDeclarationsIsNeverMisread) {
    const Words words = rich_module();
    const Interface whole = *reflect_stage(words);
    int refused = 0;
    for (std::size_t length = 0; length < words.size(); ++length) {
        const Words cut(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(length));
        const Result<Interface> interface = reflect_stage(cut);
        if (!interface) ++refused;
        // What can be read of a module that ends between two instructions is part of the whole.
        else
            EXPECT_TRUE(merge({*interface, whole}).blocks == whole.blocks) << length;
    }
    EXPECT_GT(refused, 100);  // every length that ends inside an instruction
}

TEST(RichModule, SurvivesAnyWordChanged) {
    const Words words = rich_module();
    int refused = 0;
    for (std::size_t place = 0; place < words.size(); ++place) {
        for (const std::uint32_t value :
             {0u, 1u, 8u, 0x7fffffffu, 0xffffffffu, words[place] + 1, words[place] << 16}) {
            Words changed = words;
            changed[place] = value;
            if (!survives(changed)) ++refused;
        }
    }
    EXPECT_GT(refused, 100);  // many of these changes are harmless, many are not
}

}  // namespace
}  // namespace gobo
