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
    return base + static_cast<std::uint32_t>(whole_row(step, offset, 0)[lane]);
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
    switch (code_of(operation)) {
        case spv::OpStore:
            copy(operation.result, operation.operands[0], operation.count, step.lanes);
            return 0;
        case spv::OpLoad:
        case spv::OpCopyObject:
        case spv::OpCompositeExtract:
            copy(operation.result, operation.operands[0], operation.count, kAll);
            return 0;
        case evaluate::kGather:
            gather(step, operation);
            return 0;
        case evaluate::kScatter:
            scatter(step, operation);
            return 0;
        case spv::OpCompositeConstruct:
            construct(operation);
            return 0;
        case spv::OpVectorShuffle:
            shuffle(operation);
            return 0;
        case spv::OpCompositeInsert:
            insert(operation);
            return 0;
        case spv::OpSelect:
            select(operation);
            return 0;
        case spv::OpAccessChain:
            return 0;  // an address: nothing is read
        default:
            return compute(step);
    }
}

void Definedness::copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes) {
    if (to == from) return;
    for (std::uint32_t i = 0; i < count; ++i)
        undefined_[to + i] = (undefined_[to + i] & ~lanes) | (undefined_[from + i] & lanes);
}

void Definedness::define(const evaluate::Slice& slice) {
    std::fill_n(undefined_.begin() + slice.slot, slice.count, 0);
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

void Definedness::scatter(const Step& step, const Operation& operation) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if ((step.lanes >> lane & 1U) == 0) continue;
        const std::uint32_t to = address(step, operation.result, operation.operands[1], lane);
        copy(to, operation.operands[0], operation.count, Lanes{1} << lane);
    }
}

void Definedness::construct(const Operation& operation) {
    scratch_.clear();
    for (std::uint32_t at = operation.extra; at < operation.extra + operation.extras; at += 2)
        for (std::uint32_t i = 0; i < program_.words[at + 1]; ++i)
            scratch_.push_back(undefined_[program_.words[at] + i]);
    std::copy(scratch_.begin(), scratch_.end(), undefined_.begin() + operation.result);
}

void Definedness::shuffle(const Operation& operation) {
    scratch_.clear();
    for (std::uint32_t component = 0; component < operation.count; ++component)
        scratch_.push_back(undefined_[program_.words[operation.extra + component]]);
    std::copy(scratch_.begin(), scratch_.end(), undefined_.begin() + operation.result);
}

void Definedness::insert(const Operation& operation) {
    copy(operation.result, operation.operands[1], operation.count, kAll);
    copy(operation.result + program_.words[operation.extra], operation.operands[0],
         program_.words[operation.extra + 1], kAll);
}

/// Only where both are unwritten, whichever is chosen.
void Definedness::select(const Operation& operation) {
    for (std::uint32_t i = 0; i < operation.count; ++i)
        undefined_[operation.result + i] =
            undefined_[operation.operands[1] + i] & undefined_[operation.operands[2] + i];
}

Lanes Definedness::compute(const Step& step) {
    Lanes lanes = 0;
    for (const evaluate::Slice& operand : step.info().operands)
        lanes |= undefined_in(operand.slot, operand.count);
    define(step.info().result);
    return lanes & step.lanes;
}

}  // namespace gobo::sanitize
