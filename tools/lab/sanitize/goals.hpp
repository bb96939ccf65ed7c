// What a guided search works towards: the other way of a comparison, and operands for which an operation
// would be a trap. Adding a goal is adding a row.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

/// How far each lane is from a goal: 0 once it is reached, and the larger the further off.
using Distances = std::array<float, evaluate::kLanes>;

/// A goal of every operation of one code.
struct GoalRule {
    std::uint32_t code;  ///< of the operation, as in evaluate::Row::code
    /// Lowers the distances to those of the step's lanes. Operands and result stand ready.
    void (*measure)(const evaluate::Step<float>&, Distances&);
};

/// All goals, those of one operation together.
[[nodiscard]] std::span<const GoalRule> goal_rules();

/// The goal of an operation that computes reals: a result beyond what a float holds.
void measure_overflow(const evaluate::Step<float>& step, Distances& distances);

}  // namespace gobo::sanitize
