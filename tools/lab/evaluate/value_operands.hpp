// Which words of an instruction are ids of values: included by module.hpp.
#pragma once

namespace gobo::evaluate {

template <class Use>
void for_each_value_operand(const Instruction& instruction, Use&& use) {
    std::size_t first = 1;
    if (instruction.type != 0) ++first;
    if (instruction.result != 0) ++first;
    std::size_t end = instruction.words.size();
    switch (instruction.opcode) {
        case spv::OpPhi:
        case spv::OpVariable:
        case spv::OpLabel:
        case spv::OpLine:
        case spv::OpNoLine:
        case spv::OpBranch:
        case spv::OpSelectionMerge:
        case spv::OpLoopMerge:
            return;
        case spv::OpCompositeExtract:
        case spv::OpSwitch:
        case spv::OpBranchConditional:
        case spv::OpLoad:
            end = std::min(end, first + 1);
            break;
        case spv::OpCompositeInsert:
        case spv::OpVectorShuffle:
        case spv::OpStore:
            end = std::min(end, first + 2);
            break;
        case spv::OpExtInst:
            first += 2;
            break;
        case spv::OpFunctionCall:
            first += 1;
            break;
        default:
            break;
    }
    for (std::size_t index = first; index < end; ++index) use(instruction.words[index]);
}

}  // namespace gobo::evaluate
