#include "lab/sanitize/definedness.hpp"

#include <algorithm>

#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::kLanes;
using evaluate::Operation;
using Step = evaluate::Step<float>;

constexpr Lanes kAll = ~Lanes{0};

std::uint32_t code_of(const Operation& operation) {
    return evaluate::instruction_table()[operation.row].code;
}

/// The slot that a lane's dynamic address leads to.
std::uint32_t address(const Step& step, std::uint32_t base, std::uint32_t offset_slot, std::size_t lane) {
    evaluate::Slice offset;
    offset.slot = offset_slot;
    return base + static_cast<std::uint32_t>(int_row(step, offset, 0)[lane]);
}

}  // namespace

Definedness::Definedness(const evaluate::Program& program)
    : program_(program), undefined_(program.slots), followers_(program.operations.size()) {
    for (const evaluate::Block& block : program.blocks) {
        std::uint32_t copies = 0;
        for (std::uint32_t at = block.first + block.count; at-- > block.first;) {
            followers_[at] = copies;
            copies = code_of(program.operations[at]) == evaluate::kCopy ? copies + 1 : 0;
        }
    }
}

void Definedness::begin() {
    std::fill(undefined_.begin(), undefined_.end(), 0);
    for (const auto& [slot, count] : program_.variables) std::fill_n(undefined_.begin() + slot, count, kAll);
}

Lanes Definedness::undefined_in(std::uint32_t slot, std::uint32_t count) const {
    Lanes lanes = 0;
    for (std::uint32_t at = slot; at < slot + count; ++at) lanes |= undefined_[at];
    return lanes;
}

Lanes Definedness::after(const Step& step) {
    const Lanes hits = move(step, program_.operations[step.operation]);
    for (std::uint32_t next = 1; next <= followers_[step.operation]; ++next) {
        const Operation& keep = program_.operations[step.operation + next];
        copy(keep.result, keep.operands[0], keep.count, step.lanes);
    }
    return hits;
}

Lanes Definedness::move(const Step& step, const Operation& operation) {
    const std::uint32_t* words = program_.words.data() + operation.extra;
    const auto& operands = operation.operands;
    scratch_.clear();
    switch (code_of(operation)) {
        case spv::OpStore:
            copy(operation.result, operands[0], operation.count, step.lanes);
            return 0;
        case spv::OpLoad:
        case spv::OpCopyObject:
        case spv::OpCompositeExtract:
            copy(operation.result, operands[0], operation.count, kAll);
            return 0;
        case evaluate::kGather:
            gather(step, operation);
            return 0;
        case evaluate::kScatter:
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                if ((step.lanes >> lane & 1U) != 0)
                    copy(address(step, operation.result, operands[1], lane), operands[0], operation.count,
                         Lanes{1} << lane);
            return 0;
        case spv::OpCompositeConstruct:
            for (const std::uint32_t* part = words; part < words + operation.extras; part += 2)
                scratch_.insert(scratch_.end(), undefined_.begin() + part[0],
                                undefined_.begin() + part[0] + part[1]);
            break;
        case spv::OpVectorShuffle:
            for (std::uint32_t i = 0; i < operation.count; ++i) scratch_.push_back(undefined_[words[i]]);
            break;
        case spv::OpCompositeInsert:
            copy(operation.result, operands[1], operation.count, kAll);
            copy(operation.result + words[0], operands[0], words[1], kAll);
            return 0;
        case spv::OpSelect:  // only where both are unwritten, whichever is chosen
            for (std::uint32_t i = 0; i < operation.count; ++i)
                scratch_.push_back(undefined_[operands[1] + i] & undefined_[operands[2] + i]);
            break;
        case spv::OpAccessChain:
            return 0;  // an address: nothing is read
        default:
            return compute(step);
    }
    std::copy(scratch_.begin(), scratch_.end(), undefined_.begin() + operation.result);
    return 0;
}

void Definedness::copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes) {
    if (to == from) return;
    for (std::uint32_t i = 0; i < count; ++i)
        undefined_[to + i] = (undefined_[to + i] & ~lanes) | (undefined_[from + i] & lanes);
}

void Definedness::gather(const Step& step, const Operation& operation) {
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Lanes lanes = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if ((step.lanes >> lane & 1U) == 0) continue;
            const std::uint32_t from = address(step, operation.operands[0], operation.operands[1], lane);
            lanes |= undefined_[from + component] & Lanes{1} << lane;
        }
        undefined_[operation.result + component] = lanes;
    }
}

Lanes Definedness::compute(const Step& step) {
    Lanes lanes = 0;
    for (const evaluate::Slice& operand : step.info().operands)
        lanes |= undefined_in(operand.slot, operand.count);
    std::fill_n(undefined_.begin() + step.info().result.slot, step.info().result.count, 0);
    return lanes & step.lanes;
}

}  // namespace gobo::sanitize
