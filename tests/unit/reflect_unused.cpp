#include "reflect_unused.hpp"

#include <algorithm>
#include <set>

#include "reflect/reflect.hpp"

namespace gobo {
namespace {

using Operands = std::span<const std::uint32_t>;

Operands from(Operands operands, std::size_t first, std::size_t count = std::dynamic_extent) {
    if (first >= operands.size()) return {};
    operands = operands.subspan(first);
    return operands.first(std::min(count, operands.size()));
}

/// Operands in which a pointer may stand. With logical addressing only these instructions take pointers
/// (SPIR-V specification, 2.16.1). Other operands are left alone: a literal there could look like a
/// variable's id.
Operands pointer_operands(const spirv::Instruction& instruction) {
    const Operands operands = instruction.words.subspan(1);
    switch (instruction.opcode) {
        case spv::Op::OpStore:
        case spv::Op::OpCopyMemory:
            return from(operands, 0, 2);
        case spv::Op::OpAtomicStore:
        case spv::Op::OpAtomicFlagClear:
            return from(operands, 0, 1);
        case spv::Op::OpFunctionCall:
            return from(operands, 3);
        case spv::Op::OpExtInst:
            return from(operands, 4);
        case spv::Op::OpLoad:
        case spv::Op::OpAccessChain:
        case spv::Op::OpInBoundsAccessChain:
        case spv::Op::OpPtrAccessChain:
        case spv::Op::OpCopyObject:
        case spv::Op::OpArrayLength:
        case spv::Op::OpImageTexelPointer:
            return from(operands, 2, 1);
        default:
            break;
    }
    const bool atomic =
        instruction.opcode >= spv::Op::OpAtomicLoad && instruction.opcode <= spv::Op::OpAtomicXor;
    return atomic ? from(operands, 2, 1) : Operands();
}

std::set<spirv::Id> used_pointers(const spirv::Module& module) {
    std::set<spirv::Id> used;
    bool in_function = false;
    for (const spirv::Instruction& instruction : module.instructions) {
        in_function = in_function || instruction.opcode == spv::Op::OpFunction;
        if (!in_function) continue;
        const Operands pointers = pointer_operands(instruction);
        for (const std::uint32_t pointer : pointers) used.insert(spirv::Id{pointer});
    }
    return used;
}

/// Variables of functions and of the module alone are nobody's interface.
bool is_interface(spv::StorageClass storage) {
    switch (storage) {
        case spv::StorageClassUniform:
        case spv::StorageClassUniformConstant:
        case spv::StorageClassStorageBuffer:
        case spv::StorageClassAtomicCounter:
        case spv::StorageClassInput:
        case spv::StorageClassOutput:
            return true;
        default:
            return false;
    }
}

std::vector<std::string> unused_in(const spirv::Module& module) {
    const std::set<spirv::Id> used = used_pointers(module);
    std::vector<std::string> names;
    for (const spirv::Variable& variable : module.variables) {
        if (!is_interface(variable.storage) || is_built_in(module, variable)) continue;
        if (!used.contains(variable.id)) names.push_back(interface_name(module, variable));
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace

Result<std::vector<std::string>> unused_variables(const std::vector<std::uint32_t>& words) {
    GOBO_TRY(const spirv::Module module, spirv::read_module(words));
    return unused_in(module);
}

}  // namespace gobo
