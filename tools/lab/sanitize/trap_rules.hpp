// What counts as an undefined operation: adding a trap is adding a row.
#pragma once

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

/// All traps, those of one operation together, the more telling first.
[[nodiscard]] std::span<const TrapRule> trap_rules();

/// The row of a slice's component: one number of each lane.
[[nodiscard]] inline const float* real_row(const evaluate::Step<float>& step, const evaluate::Slice& slice,
                                           std::uint32_t component) {
    return step.rows + (std::size_t{slice.slot} + component) * evaluate::kLanes;
}
[[nodiscard]] inline const std::int32_t* whole_row(const evaluate::Step<float>& step,
                                                   const evaluate::Slice& slice, std::uint32_t component) {
    return reinterpret_cast<const std::int32_t*>(real_row(step, slice, component));
}

}  // namespace gobo::sanitize
