#include "lab/sanitize/decision_observer.hpp"

#include <bit>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

/// What makes a number jump.
bool is_step(std::uint32_t code) {
    switch (code) {
        case spv::OpConvertFToS:
        case spv::OpConvertFToU:
        case evaluate::kExtended + GLSLstd450Floor:
        case evaluate::kExtended + GLSLstd450Ceil:
        case evaluate::kExtended + GLSLstd450Round:
        case evaluate::kExtended + GLSLstd450RoundEven:
        case evaluate::kExtended + GLSLstd450Trunc:
        case evaluate::kExtended + GLSLstd450FSign:
        case evaluate::kExtended + GLSLstd450Step:
            return true;
        default:
            return false;
    }
}

}  // namespace

template <class T>
DecisionObserver<T>::DecisionObserver(const evaluate::Program& program, std::size_t invocations)
    : decided_(invocations) {
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        const bool makes_truth = program.infos[at].result.scalar == evaluate::Scalar::boolean;
        decides_.push_back(is_step(row.code) || (makes_truth && row.kind == evaluate::Kind::compare));
    }
}

template <class T>
void DecisionObserver<T>::after(const evaluate::Step<T>& step) {
    if (!decides_[step.operation]) return;
    const evaluate::Slice& result = step.info().result;
    for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
        if ((step.lanes >> lane & 1U) == 0) continue;
        std::uint64_t& decided = decided_[step.first_invocation + lane];
        for (std::uint32_t c = 0; c < result.count; ++c) {
            const auto value = static_cast<float>(step.value(result, c, lane));
            decided = (decided ^ std::bit_cast<std::uint32_t>(value) ^ step.operation) * 0x100000001b3U;
        }
    }
}

template class DecisionObserver<float>;
template class DecisionObserver<double>;

}  // namespace gobo::sanitize
