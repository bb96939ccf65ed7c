// What is watched of every operation. Traps: operands for which it must not be executed. Goals: what a guided
// search works towards, the other way of a comparison and operands near a trap. Adding one is adding a row.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

/// Bit i: lane i.
using Lanes = std::uint64_t;

/// A trap: an operation together with the operands for which it must not be executed.
struct TrapRule {
    std::uint32_t code;        ///< of the operation, as in evaluate::Row::code
    std::string_view message;  ///< "division by zero"
    /// The result may well be a finite number, so the operands are looked at each time; the others are asked
    /// only once a result is not finite.
    bool is_silent;
    /// The lanes that run the step and in which it happens. The operands stand ready.
    Lanes (*happens_in)(const evaluate::Step<float>&);
};

/// How far each lane is from a goal: 0 once it is reached, and the larger the further off.
using Distances = std::array<float, evaluate::kLanes>;

/// A goal of every operation of one code.
struct GoalRule {
    std::uint32_t code;  ///< of the operation, as in evaluate::Row::code
    /// Lowers the distances to those of the step's lanes. Operands and result stand ready.
    void (*measure)(const evaluate::Step<float>&, Distances&);
};

/// All rules; those of one operation stand together, of traps the more telling first.
[[nodiscard]] std::span<const TrapRule> trap_rules();
[[nodiscard]] std::span<const GoalRule> goal_rules();

/// Those of one operation.
template <class Rule>
[[nodiscard]] std::span<const Rule> rules_of(std::span<const Rule> all, std::uint32_t code) {
    const auto is_other = [code](const Rule& rule) { return rule.code != code; };
    const auto first = std::find_if_not(all.begin(), all.end(), is_other);
    return {first, std::find_if(first, all.end(), is_other)};
}

/// The goal of an operation that computes floats: a result beyond what a float holds.
void measure_overflow(const evaluate::Step<float>& step, Distances& distances);

/// The lanes that run the step and in which a component of the slice is NaN or infinite.
[[nodiscard]] Lanes not_finite(const evaluate::Step<float>& step, const evaluate::Slice& slice);

/// The row of a slice's component: one number of each lane.
[[nodiscard]] inline const float* float_row(const evaluate::Step<float>& step, const evaluate::Slice& slice,
                                            std::uint32_t component) {
    return step.rows + (std::size_t{slice.slot} + component) * evaluate::kLanes;
}
[[nodiscard]] inline const std::int32_t* int_row(const evaluate::Step<float>& step,
                                                 const evaluate::Slice& slice, std::uint32_t component) {
    return reinterpret_cast<const std::int32_t*>(float_row(step, slice, component));
}

}  // namespace gobo::sanitize
