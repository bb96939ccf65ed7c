// The functions of a module as blocks: in which order those run, and how long values live.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <unordered_map>
#include <vector>

#include "spirv/module.hpp"

namespace gobo::evaluate {

/// Instructions [first, terminator] of the module, after a label.
struct BasicBlock {
    spirv::Id label = spirv::Id::none;
    std::uint32_t first = 0;
    std::uint32_t terminator = 0;
    spirv::Id merge = spirv::Id::none;        ///< label named by OpSelectionMerge or OpLoopMerge
    spirv::Id continue_to = spirv::Id::none;  ///< label named by OpLoopMerge
    std::vector<spirv::Id> next;              ///< labels that the terminator names
};

struct Function {
    spirv::Id id = spirv::Id::none;
    std::uint32_t line = 0;
    std::vector<spirv::Id> parameters;
    std::vector<BasicBlock> blocks;  ///< the first one is the entry
    std::unordered_map<spirv::Id, std::size_t> block_of_label;
};
using Functions = std::unordered_map<spirv::Id, Function>;

/// Every fault of structure (a block in a block, a module that ends inside a function) is an error.
[[nodiscard]] Result<Functions> read_functions(const spirv::Module& module);

/// The function's reachable blocks (indices), so that whoever leaves a construct waits at a later block than
/// those who stay inside: reverse post-order in which the block where a construct merges comes after all of
/// its content, and a loop's continue block after its body. Running the earliest block that any lane waits at
/// then brings lanes together again. Labels that name no block are left out.
[[nodiscard]] std::vector<std::size_t> structured_order(const Function& function);

/// Where an id is used inside its function.
struct Uses {
    std::size_t block = 0;    ///< that defines it
    std::uint32_t count = 0;  ///< of operands that name it
    bool is_local = true;     ///< all in the block that defines it
    std::uint32_t last = 0;   ///< instruction of the last use in that block
};
using UsesById = std::unordered_map<spirv::Id, Uses>;

/// Of the ids that the function defines. An operand of OpPhi is used at the end of the block it comes from.
[[nodiscard]] UsesById uses_in(const spirv::Module& module, const Function& function);

/// The operands of the instruction that are ids of values or pointers. An OpPhi has none: its operands belong
/// to the ends of the blocks it names.
[[nodiscard]] std::span<const std::uint32_t> value_operands(const spirv::Instruction& instruction);

[[nodiscard]] inline bool is_one_of(spv::Op opcode, std::initializer_list<spv::Op> list) {
    return std::find(list.begin(), list.end(), opcode) != list.end();
}

/// atomicAdd() and its like.
[[nodiscard]] inline bool is_atomic(spv::Op opcode) {
    return (opcode >= spv::OpAtomicLoad && opcode <= spv::OpAtomicXor) || opcode == spv::OpAtomicFAddEXT;
}

/// An error in the shader at that place.
[[nodiscard]] Diagnostic error_at(const Place& place, std::string message, std::string help = {});

/// "OpFAdd"; "instruction 4711" where SPIRV-Tools knows no name.
[[nodiscard]] std::string opcode_name(spv::Op opcode);

}  // namespace gobo::evaluate
