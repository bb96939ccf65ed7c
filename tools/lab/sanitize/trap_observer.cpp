#include "lab/sanitize/trap_observer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using evaluate::Slice;
using Step = evaluate::Step<float>;

constexpr float kLargest = std::numeric_limits<float>::max();

/// Operations that compute reals; the others hand on what others made.
bool computes(Kind kind) {
    return kind <= Kind::matrix;
}

/// The lanes in which a component is NaN or infinite.
Lanes not_finite(const Step& step, const Slice& slice) {
    std::array<std::int32_t, kLanes> hits{};
    for (std::uint32_t component = 0; component < slice.count; ++component) {
        const float* row = real_row(step, slice, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) hits[lane] |= !(std::fabs(row[lane]) <= kLargest);
    }
    std::int32_t any = 0;
    for (const std::int32_t hit : hits) any |= hit;
    if (any == 0) return 0;
    Lanes lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes |= static_cast<Lanes>(hits[lane] != 0) << lane;
    return lanes & step.lanes;
}

Lanes is_nan(const Step& step, const Slice& slice, Lanes lanes) {
    Lanes result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        for (std::uint32_t component = 0; component < slice.count && (lanes >> lane & 1U) != 0; ++component)
            if (std::isnan(real_row(step, slice, component)[lane])) result |= Lanes{1} << lane;
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

}  // namespace

TrapObserver::TrapObserver(const evaluate::Program& program) : program_(program), definedness_(program) {
    for (std::uint32_t at = 0; at < program.operations.size(); ++at)
        watches_.push_back(watch_of(program, at));
}

TrapObserver::Watch TrapObserver::watch_of(const evaluate::Program& program, std::uint32_t operation) {
    const evaluate::Row& row = evaluate::instruction_table()[program.operations[operation].row];
    const auto rules = trap_rules();
    const auto first =
        std::find_if(rules.begin(), rules.end(), [&](const TrapRule& rule) { return rule.code == row.code; });
    const auto last =
        std::find_if(first, rules.end(), [&](const TrapRule& rule) { return rule.code != row.code; });
    Watch watch;
    watch.first_rule = static_cast<std::uint32_t>(first - rules.begin());
    watch.rules = static_cast<std::uint32_t>(last - first);
    watch.has_silent = std::any_of(first, last, [](const TrapRule& rule) { return rule.is_silent; });
    watch.makes_reals =
        computes(row.kind) && program.infos[operation].result.scalar == evaluate::Scalar::float32;
    return watch;
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
    if (watch.has_silent || watch.makes_reals) judge(step, watch);
}

void TrapObserver::judge(const Step& step, const Watch& watch) {
    Lanes told = 0;
    for (const TrapRule& rule : trap_rules().subspan(watch.first_rule, watch.rules)) {
        if (!rule.is_silent) continue;
        const Lanes lanes = rule.happens_in(step) & ~told;
        if (lanes != 0) add(step, rule.message, lanes);
        told |= lanes;
    }
    if (watch.makes_reals) judge_result(step, watch, ~told);
}

/// A result that is not finite, though all operands are.
void TrapObserver::judge_result(const Step& step, const Watch& watch, Lanes lanes) {
    const Slice& result = step.info().result;
    lanes &= not_finite(step, result);
    for (const Slice& operand : step.info().operands)
        if (lanes != 0 && operand.scalar == evaluate::Scalar::float32) lanes &= ~not_finite(step, operand);
    if (lanes == 0) return;
    for (const TrapRule& rule : trap_rules().subspan(watch.first_rule, watch.rules)) {
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

}  // namespace gobo::sanitize
