// A SPIR-V module as instructions, with the names, decorations and source places that its ids carry.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <spirv/unified1/spirv.hpp>

#include "core/diagnostic.hpp"

namespace gobo::evaluate {

/// One instruction. Reading past its end gives 0, which is no valid id, so that truncated modules end in a
/// diagnostic and never in a wild read.
struct Instruction {
    spv::Op opcode = spv::OpNop;
    std::span<const std::uint32_t> words;  ///< with the leading word
    std::uint32_t place = 0;               ///< index into Module::places
    std::uint32_t result = 0;              ///< id that it defines, or 0
    std::uint32_t type = 0;                ///< id of the type of its result, or 0

    [[nodiscard]] std::uint32_t word(std::size_t index) const {
        return index < words.size() ? words[index] : 0;
    }
};

/// What OpDecorate and OpMemberDecorate say, as far as evaluation needs it. Offsets and strides in bytes.
struct Decorations {
    std::optional<std::uint32_t> location, builtin, offset, array_stride, matrix_stride, spec_id;
    bool row_major = false;
    bool no_contraction = false;
};

/// A basic block: instructions [first, terminator] of Module::instructions, after its label.
struct BasicBlock {
    std::uint32_t label = 0;
    std::uint32_t first = 0;
    std::uint32_t terminator = 0;
    std::uint32_t merge = 0;          ///< label named by OpSelectionMerge or OpLoopMerge, or 0
    std::uint32_t continue_to = 0;    ///< label named by OpLoopMerge, or 0
    std::vector<std::uint32_t> next;  ///< labels that the terminator names
};

struct Function {
    std::uint32_t id = 0;
    std::uint32_t place = 0;
    std::vector<std::uint32_t> parameters;
    std::vector<BasicBlock> blocks;  ///< the first one is the entry
    std::unordered_map<std::uint32_t, std::size_t> block_of_label;
};

struct EntryPoint {
    std::uint32_t model = 0;  ///< spv::ExecutionModel
    std::uint32_t function = 0;
    std::string name;
};

/// Views into the words it was read from: those must outlive it.
struct Module {
    std::uint32_t bound = 0;  ///< ids are below it
    std::vector<Instruction> instructions;
    std::vector<Place> places;  ///< places[0] is unknown
    std::vector<EntryPoint> entry_points;
    std::vector<std::uint32_t> definitions;  ///< by id: index into instructions plus 1, or 0
    std::unordered_map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names;
    std::map<std::pair<std::uint32_t, std::int64_t>, Decorations> decorations;  ///< by id and member, or -1
    std::uint32_t std450 = 0;  ///< id of the GLSL.std.450 instruction set, or 0
    std::unordered_map<std::uint32_t, Function> functions;

    /// The instruction that defines `id`; nullptr where there is none.
    [[nodiscard]] const Instruction* definition(std::uint32_t id) const;
    [[nodiscard]] std::string name_of(std::uint32_t id) const;
    [[nodiscard]] std::string member_name(std::uint32_t type, std::uint32_t member) const;
    /// What decorates `id` (or one member of a struct type); nothing set where nothing does.
    [[nodiscard]] const Decorations& decorations_of(std::uint32_t id, std::int64_t member = -1) const;
};

/// Splits the words into instructions and collects names, decorations, places and functions. Every structural
/// fault (not SPIR-V, other byte order, truncated, an id out of bounds or defined twice) is a diagnostic.
[[nodiscard]] Result<Module> read_module(std::span<const std::uint32_t> words);

/// A string literal starting at word `index` of the instruction, and the index of the word after it.
[[nodiscard]] std::pair<std::string, std::size_t> literal_string(const Instruction& instruction,
                                                                 std::size_t index);

/// An error in the shader at that place.
[[nodiscard]] Diagnostic error_at(const Place& place, std::string message, std::string help = {});

/// "OpFAdd"; "instruction 4711" where SPIRV-Tools knows no name.
[[nodiscard]] std::string opcode_name(spv::Op opcode);

/// Calls `use(id)` for each operand of the instruction that is the id of a value or pointer. An OpPhi has
/// none: its operands belong to the ends of the blocks it names.
template <class Use>
void for_each_value_operand(const Instruction& instruction, Use&& use);

}  // namespace gobo::evaluate

#include "lab/evaluate/value_operands.hpp"
