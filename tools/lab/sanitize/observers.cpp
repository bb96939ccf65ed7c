#include "lab/sanitize/observers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/ranges.h>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using evaluate::Slice;
using Step = evaluate::Step<float>;

/// Operations that compute floats; the others pass on what others made.
bool computes(Kind kind) {
    return kind <= Kind::matrix;
}

Lanes is_nan(const Step& step, const Slice& slice, Lanes lanes) {
    Lanes result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        for (std::uint32_t component = 0; component < slice.count && (lanes >> lane & 1U) != 0; ++component)
            if (std::isnan(float_row(step, slice, component)[lane])) result |= Lanes{1} << lane;
    return result;
}

/// The sign of a NaN means nothing, and is not the same on every machine.
float without_sign_of_nan(float value) {
    return std::isnan(value) ? std::numeric_limits<float>::quiet_NaN() : value;
}

/// "depth = 0", "(1, 0.5, 0.25)".
std::string value_text(const Step& step, const Slice& slice, std::size_t lane) {
    std::vector<float> components;
    for (std::uint32_t component = 0; component < slice.count; ++component)
        components.push_back(without_sign_of_nan(static_cast<float>(step.value(slice, component, lane))));
    const std::string numbers = components.size() == 1 ? fmt::format("{}", components.front())
                                                       : fmt::format("({})", fmt::join(components, ", "));
    const std::string& name = step.program.names[slice.name];
    return name.empty() ? numbers : fmt::format("{} = {}", name, numbers);
}

/// "FDiv 1, depth = 0 -> inf".
std::string operation_text(const Step& step, std::size_t lane) {
    std::vector<std::string> operands;
    for (const Slice& operand : step.info().operands) operands.push_back(value_text(step, operand, lane));
    return fmt::format("{} {} -> {}", step.name(), fmt::join(operands, ", "),
                       value_text(step, step.info().result, lane));
}

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Operations whose results can be much larger than their operands.
bool can_overflow(Kind kind) {
    return kind == Kind::mul || kind == Kind::div || kind == Kind::pow || kind == Kind::exp ||
           kind == Kind::dot || kind == Kind::matrix || kind == Kind::inverse_sqrt;
}

}  // namespace

TrapObserver::TrapObserver(const evaluate::Program& program, ReachObserver* reach)
    : program_(program), definedness_(program), reach_(reach) {
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        Watch& watch = watches_.emplace_back();
        watch.rules = rules_of(trap_rules(), row.code);
        watch.has_silent = std::any_of(watch.rules.begin(), watch.rules.end(),
                                       [](const TrapRule& rule) { return rule.is_silent; });
        watch.makes_floats =
            computes(row.kind) && program.infos[at].result.scalar == evaluate::Scalar::float32;
    }
}

void TrapObserver::begin_batch(std::size_t first_invocation) {
    finish();
    is_in_batch_ = true;
    batch_ = first_invocation;
    definedness_.begin();
}

void TrapObserver::finish() {
    if (!is_in_batch_) return;
    is_in_batch_ = false;
    for (std::size_t output = 0; output < program_.outputs.size(); ++output) {
        const evaluate::Port& port = program_.outputs[output];
        const Lanes lanes = definedness_.undefined_in(port.slot, port.components);
        if (lanes != 0) unwritten_.push_back({batch_, output, lanes});
    }
}

void TrapObserver::after(const Step& step) {
    if (!is_in_batch_ || step.first_invocation != batch_) begin_batch(step.first_invocation);
    if (const Lanes lanes = definedness_.after(step); lanes != 0)
        add(step, "a value is read before it is written", lanes);
    const Watch& watch = watches_[step.operation];
    if (watch.has_silent || watch.makes_floats) judge(step, watch);
    if (reach_ != nullptr) reach_->after(step);
}

void TrapObserver::judge(const Step& step, const Watch& watch) {
    Lanes told = 0;
    for (const TrapRule& rule : watch.rules) {
        if (!rule.is_silent) continue;
        const Lanes lanes = rule.happens_in(step) & ~told;
        if (lanes != 0) add(step, rule.message, lanes);
        told |= lanes;
    }
    if (watch.makes_floats) judge_result(step, watch, ~told);
}

/// A result that is not finite, though all operands are.
void TrapObserver::judge_result(const Step& step, const Watch& watch, Lanes lanes) {
    const Slice& result = step.info().result;
    lanes &= not_finite(step, result);
    for (const Slice& operand : step.info().operands)
        if (lanes != 0 && operand.scalar == evaluate::Scalar::float32) lanes &= ~not_finite(step, operand);
    if (lanes == 0) return;
    for (const TrapRule& rule : watch.rules) {
        if (rule.is_silent) continue;
        const Lanes explained = lanes & rule.happens_in(step);
        if (explained != 0) add(step, rule.message, explained);
        lanes &= ~explained;
    }
    const Lanes nan = is_nan(step, result, lanes);
    if (nan != 0) add(step, "a NaN made from finite numbers", nan);
    if ((lanes & ~nan) != 0) add(step, "an infinity made from finite numbers", lanes & ~nan);
}

void TrapObserver::add(const Step& step, std::string_view message, Lanes lanes) {
    Hit& hit = hits_[{step.operation, message}];
    if (hit.invocations == 0) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        hit.first = step.first_invocation + lane;
        hit.operation = operation_text(step, lane);
    }
    hit.invocations += static_cast<std::uint64_t>(std::popcount(lanes));
    mark_trapped(lanes);
}

void TrapObserver::mark_trapped(Lanes lanes) {
    const std::size_t batch = batch_ / kLanes;
    if (batch >= trapped_.size()) trapped_.resize(batch + 1);
    trapped_[batch] |= lanes;
}

void TrapObserver::clamped(const Step& step, std::size_t lane, std::int64_t index, std::uint32_t extent) {
    if (!is_in_batch_ || step.first_invocation != batch_) begin_batch(step.first_invocation);
    mark_trapped(Lanes{1} << lane);
    Hit& hit = hits_[{step.operation, "array index out of bounds"}];
    if (hit.invocations++ > 0) return;
    hit.first = step.first_invocation + lane;
    hit.operation =
        fmt::format("{}, index {} of {}", step.program.names[step.info().result.name], index, extent);
}

ReachObserver::ReachObserver(const evaluate::Program& program) {
    std::size_t goals = 0;
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        Watch& watch = watches_.emplace_back();
        watch.rules = rules_of(goal_rules(), row.code);
        watch.may_overflow =
            can_overflow(row.kind) && program.infos[at].result.scalar == evaluate::Scalar::float32;
        watch.first_goal = goals;
        goals += watch.rules.size() + (watch.may_overflow ? 1 : 0);
    }
    reaches_.resize(goals);
}

std::vector<std::size_t> ReachObserver::advanced() const {
    std::vector<std::size_t> goals;
    for (std::size_t goal = 0; goal < reaches_.size(); ++goal)
        if (reaches_[goal].run == run_) goals.push_back(goal);
    return goals;
}

void ReachObserver::after(const Step& step) {
    const Watch& watch = watches_[step.operation];
    std::size_t goal = watch.first_goal;
    Distances distances;
    for (const GoalRule& rule : watch.rules) {
        Reach& reach = reaches_[goal++];
        if (reach.is_reached()) continue;
        distances.fill(kFar);
        rule.measure(step, distances);
        keep_nearest(step, distances, reach);
    }
    if (watch.may_overflow && !reaches_[goal].is_reached()) {
        distances.fill(kFar);
        measure_overflow(step, distances);
        keep_nearest(step, distances, reaches_[goal]);
    }
}

void ReachObserver::keep_nearest(const Step& step, const Distances& distances, Reach& reach) const {
    float nearest = kFar;
    for (const float distance : distances) nearest = distance < nearest ? distance : nearest;
    if (nearest >= reach.distance) return;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((step.lanes >> lane & 1U) != 0 && distances[lane] < reach.distance)
            reach = {distances[lane], run_, step.first_invocation + lane};
}

}  // namespace gobo::sanitize
