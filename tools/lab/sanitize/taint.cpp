#include "lab/sanitize/taint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using evaluate::Operation;
using evaluate::Slice;
using Step = evaluate::Step<float>;

constexpr Lanes kAll = ~Lanes{0};

bool has(Lanes lanes, std::size_t lane) {
    return (lanes >> lane & 1U) != 0;
}

std::size_t first_lane(Lanes lanes) {
    return static_cast<std::size_t>(std::countr_zero(lanes));
}

/// The slot that a lane's dynamic address leads to.
std::uint32_t address(const Step& step, std::uint32_t base, std::uint32_t offset_slot, std::size_t lane) {
    Slice offset;
    offset.slot = offset_slot;
    return base + static_cast<std::uint32_t>(int_row(step, offset, 0)[lane]);
}

/// The operand that decides what such an operation gives, whatever the other is.
std::optional<std::int32_t> deciding_value(std::uint32_t code) {
    switch (code) {
        case spv::OpLogicalAnd:
        case spv::OpBitwiseAnd:
        case spv::OpIMul:
            return 0;
        case spv::OpLogicalOr:
            return 1;
        case spv::OpBitwiseOr:
            return -1;
        default:
            return std::nullopt;
    }
}

/// Whether component i of the result comes of component i of the operands alone.
bool is_by_component(const evaluate::Row& row) {
    switch (row.code) {
        case spv::OpMatrixTimesVector:
        case spv::OpVectorTimesMatrix:
        case spv::OpMatrixTimesMatrix:
        case spv::OpOuterProduct:
            return false;
        default:
            return row.kind != Kind::geometric && row.kind != Kind::dot && row.kind != Kind::matrix &&
                   row.kind != Kind::image;
    }
}

}  // namespace

Taint::Taint(const evaluate::Program& program) : program_(program), states_(program.slots) {
    causes_.push_back({});
    for (std::size_t i = 0; i < program.variables.size(); ++i) causes_.push_back({Cause::Kind::unwritten, i});
    for (std::size_t i = 0; i < program.undefined.size(); ++i) causes_.push_back({Cause::Kind::no_return, i});
    causes_.push_back({Cause::Kind::constant, 0});
    fixed_causes_ = static_cast<CauseId>(causes_.size());
    first_uses_.resize(fixed_causes_);
}

void Taint::begin() {
    std::fill(states_.begin(), states_.end(), State{});
    for (auto& uses : first_uses_) uses.clear();
    CauseId id = 1;
    const auto fill = [&](std::uint32_t slot, std::uint32_t count) {
        std::fill_n(states_.begin() + slot, count, State{kAll, 0, id, 0});
        ++id;
    };
    for (const auto& [slot, count] : program_.variables) fill(slot, count);
    for (const evaluate::UndefinedValue& value : program_.undefined) fill(value.slot, value.count);
    for (const evaluate::ConstantSlot& constant : program_.constants)
        if (constant.scalar == evaluate::Scalar::float32 &&
            !std::isfinite(std::bit_cast<float>(constant.bits)))
            states_[constant.slot] = {kAll, 0, id, 0};
}

Lanes Taint::lanes_of(std::uint32_t slot, std::uint32_t count) const {
    Lanes lanes = 0;
    for (std::uint32_t at = slot; at < slot + count; ++at) lanes |= states_[at].lanes;
    return lanes;
}

const Cause& Taint::cause_of(std::uint32_t slot, std::uint32_t count, std::size_t lane) const {
    for (std::uint32_t at = slot; at < slot + count; ++at)
        if (has(states_[at].lanes, lane)) return causes_[states_[at].cause_in(lane)];
    return causes_.front();
}

Lanes Taint::operands_of(const Step& step) const {
    Lanes lanes = 0;
    for (const Slice& operand : step.info().operands) lanes |= lanes_of(operand);
    return lanes;
}

const Cause& Taint::operand_cause(const Step& step, std::size_t lane) const {
    for (const Slice& operand : step.info().operands)
        if (has(lanes_of(operand), lane)) return cause_of(operand.slot, operand.count, lane);
    return causes_.front();
}

std::optional<std::uint32_t> Taint::first_use(const Cause& cause, std::size_t lane) const {
    for (CauseId id = 1; id < fixed_causes_; ++id)
        if (causes_[id].kind == cause.kind && causes_[id].index == cause.index && !first_uses_[id].empty() &&
            first_uses_[id][lane] != 0)
            return first_uses_[id][lane] - 1;
    return std::nullopt;
}

void Taint::after(const Step& step) {
    used_ = 0;
    move(step, program_.operations[step.operation]);
}

void Taint::copied(const Operation& one, Lanes lanes) {
    copy(one.result, one.operands[0], one.count, lanes);
}

void Taint::mark(const Step& step, Lanes lanes, const Cause& cause) {
    const CauseId id = id_of(cause);
    const Operation& operation = program_.operations[step.operation];
    if (row_of(operation).code == evaluate::kScatter) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            for (std::uint32_t i = 0; i < operation.count && has(lanes, lane); ++i) {
                State& known = states_[address(step, operation.result, operation.operands[1], lane) + i];
                State state{Lanes{1} << lane, 0, id, 0};
                state.add(known, fixed_causes_);
                known = state;
            }
        return;
    }
    const bool is_address =
        row_of(operation).code == spv::OpAccessChain;  // whose result is told as a variable
    const Slice& result = step.info().result;
    const std::uint32_t first = is_address ? operation.result : result.slot;
    const std::uint32_t count = is_address ? 1 : result.count;
    for (std::uint32_t at = first; at < first + count; ++at) {
        State state{lanes, 0, id, 0};
        state.add(states_[at], fixed_causes_);
        states_[at] = state;
    }
}

Taint::CauseId Taint::id_of(const Cause& cause) {
    for (CauseId id = static_cast<CauseId>(causes_.size()); id-- > 1;)
        if (causes_[id].kind == cause.kind && causes_[id].index == cause.index) return id;
    causes_.push_back(cause);
    return static_cast<CauseId>(causes_.size() - 1);
}

void Taint::State::add(const State& more, CauseId told) {
    if (lanes == 0) {
        *this = more;
        return;
    }
    const Lanes fresh = more.lanes & ~lanes;
    if (fresh == 0) return;
    lanes |= fresh;
    const auto join = [&](Lanes some, CauseId id) {
        if (some == 0 || id == cause) return;
        if (others == 0 || other_cause < told) other_cause = id;
        others |= some;
    };
    join(fresh & ~more.others, more.cause);
    join(fresh & more.others, more.other_cause);
}

void Taint::move(const Step& step, const Operation& operation) {
    const std::uint32_t* words = program_.words.data() + operation.extra;
    const auto& operands = operation.operands;
    scratch_.clear();
    switch (row_of(operation).code) {
        case spv::OpStore:
            return copy(operation.result, operands[0], operation.count, step.lanes);
        case spv::OpLoad:
        case spv::OpCopyObject:
        case spv::OpCompositeExtract:
            return copy(operation.result, operands[0], operation.count, kAll);
        case evaluate::kGather:
            return gather(step, operation);
        case evaluate::kScatter:
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                if (has(step.lanes, lane))
                    copy(address(step, operation.result, operands[1], lane), operands[0], operation.count,
                         Lanes{1} << lane);
            return;
        case spv::OpCompositeConstruct:
            for (const std::uint32_t* part = words; part < words + operation.extras; part += 2)
                scratch_.insert(scratch_.end(), states_.begin() + part[0],
                                states_.begin() + part[0] + part[1]);
            break;
        case spv::OpVectorShuffle:
            for (std::uint32_t i = 0; i < operation.count; ++i) scratch_.push_back(states_[words[i]]);
            break;
        case spv::OpCompositeInsert:
            copy(operation.result, operands[1], operation.count, kAll);
            return copy(operation.result + words[0], operands[0], words[1], kAll);
        case spv::OpSelect:
            return select(step, operation);
        case spv::OpAccessChain:
            return compute_address(operation, step);
        default:
            return compute(step);
    }
    std::copy(scratch_.begin(), scratch_.end(), states_.begin() + operation.result);
}

void Taint::copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes) {
    if (to == from) return;
    for (std::uint32_t i = 0; i < count; ++i) {
        State state = states_[from + i].within(lanes);
        state.add(states_[to + i].within(~lanes), fixed_causes_);
        states_[to + i] = state;
    }
}

void Taint::gather(const Step& step, const Operation& operation) {
    const State offset = states_[operation.operands[1]];
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        State result;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (!has(step.lanes, lane)) continue;
            const State& from =
                states_[address(step, operation.operands[0], operation.operands[1], lane) + component];
            result.add(from.within(Lanes{1} << lane), fixed_causes_);
        }
        result.add(offset.within(step.lanes), fixed_causes_);
        scratch_.push_back(result);
    }
    std::copy(scratch_.begin(), scratch_.end(), states_.begin() + operation.result);
}

/// The lanes in which the condition holds.
Lanes Taint::conditions(const Step& step, const Slice& condition, std::uint32_t component) const {
    const std::int32_t* row = int_row(step, condition, component);
    Lanes lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes |= static_cast<Lanes>(row[lane] != 0) << lane;
    return lanes;
}

/// What is chosen, and all where the condition is undefined. The condition must still stand ready, so that a
/// result in its slots is no problem: it is of another type.
void Taint::select(const Step& step, const Operation& operation) {
    const Slice& condition = step.info().operands[0];
    Lanes used = 0;
    for (std::uint32_t i = 0; i < operation.count; ++i) {
        const std::uint32_t component = condition.count > 1 ? i : 0;
        const Lanes holds = conditions(step, condition, component);
        const State& asked = states_[condition.slot + component];
        const State& first = states_[operation.operands[1] + i];
        const State& second = states_[operation.operands[2] + i];
        State result = first.within(holds);
        result.add(second.within(~holds), fixed_causes_);
        result.add(asked, fixed_causes_);
        used |= asked.lanes;
        scratch_.push_back(result);
    }
    if ((used & step.lanes) != 0) note_use(step, used & step.lanes);
    std::copy(scratch_.begin(), scratch_.end(), states_.begin() + operation.result);
}

/// Of the indices, and of the address that they start from.
void Taint::compute_address(const Operation& operation, const Step& step) {
    const std::uint32_t before = program_.words[operation.extra];
    State result = before == 0 ? State{} : states_[before - 1];
    for (const Slice& operand : step.info().operands) {
        result.add(states_[operand.slot], fixed_causes_);
    }
    if ((result.lanes & step.lanes) != 0) note_use(step, result.lanes & step.lanes);
    states_[operation.result] = result;
}

void Taint::compute(const Step& step) {
    const evaluate::OperationInfo& info = step.info();
    const std::uint32_t code = step.row().code;
    const bool has_two_results = code == evaluate::kExtended + GLSLstd450ModfStruct ||
                                 code == evaluate::kExtended + GLSLstd450FrexpStruct;
    const std::uint32_t count =
        has_two_results ? 2 * program_.operations[step.operation].count : std::max(info.result.count, 1U);
    const Lanes decided = decided_by_other(step);
    const Lanes any = operands_of(step) & ~decided;
    if (any == 0) {
        for (std::uint32_t i = 0; i < count; ++i) states_[info.result.slot + i].lanes = 0;
        return;
    }
    note_use(step, any & step.lanes);
    const bool is_by_component = sanitize::is_by_component(step.row());
    for (std::uint32_t i = 0; i < count; ++i) {
        State result;
        for (const Slice& operand : info.operands) {
            const bool is_single = is_by_component && (operand.count == count || has_two_results);
            const std::uint32_t first = is_single ? i % operand.count : 0;
            for (std::uint32_t c = first; c < (is_single ? first + 1 : operand.count); ++c) {
                result.add(states_[operand.slot + c].within(~decided), fixed_causes_);
            }
        }
        scratch_.push_back(result);
    }
    std::copy(scratch_.begin(), scratch_.end(), states_.begin() + info.result.slot);
}

/// The lanes in which one operand is undefined, but the other decides what comes of it: false && b. Where the
/// compiler sees no effects it computes both sides, so what the right side read there was no read.
Lanes Taint::decided_by_other(const Step& step) {
    const std::optional<std::int32_t> decider = deciding_value(step.row().code);
    const auto& operands = step.info().operands;
    if (!decider || operands_of(step) == 0 || operands[0].count != 1) return 0;
    Lanes decided = 0;
    for (const std::size_t i : {0U, 1U}) {
        const std::int32_t* row = int_row(step, operands[i], 0);
        const Lanes open = lanes_of(operands[1 - i]) & ~lanes_of(operands[i]);
        for (std::size_t lane = 0; lane < kLanes && open != 0; ++lane)
            if (has(open, lane) && row[lane] == *decider) decided |= Lanes{1} << lane;
    }
    for (std::size_t lane = 0; lane < kLanes && decided != 0; ++lane)
        for (auto& uses : first_uses_)
            if (has(decided & step.lanes, lane) && !uses.empty() && uses[lane] != 0 &&
                program_.place_of(uses[lane] - 1).line == step.place().line)
                uses[lane] = 0;
    return decided;
}

/// Remembers where each lane first computed with what nobody wrote.
void Taint::note_use(const Step& step, Lanes lanes) {
    used_ |= lanes;
    for (const Slice& operand : step.info().operands)
        for (std::uint32_t at = operand.slot; at < operand.slot + operand.count; ++at) {
            const State& state = states_[at];
            const Lanes undefined = state.lanes & lanes;
            for (std::size_t lane = first_lane(undefined | Lanes{1} << (kLanes - 1)); lane < kLanes; ++lane) {
                const CauseId cause = state.cause_in(lane);
                if (!has(undefined, lane) || cause >= fixed_causes_) continue;
                std::vector<std::uint32_t>& uses = first_uses_[cause];
                uses.resize(kLanes);
                if (uses[lane] == 0) uses[lane] = step.operation + 1;
            }
        }
}

}  // namespace gobo::sanitize
