// A stage without an oracle: its fp32 evaluation against its fp64 one.
#pragma once

#include <vector>

#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

/// Evaluates the stage at `count` points of the family's domains (within 1e3; from -1 to 1 where none is
/// declared) and compares fp32 with fp64.
///
/// There are no equations to derive a bound from. Instead the inputs are moved by a rounding up or down, at
/// random, in several fp64 evaluations: what the outputs spread by is their condition, and a float evaluation
/// may be off by kConditionFactor times that. Where moving them by 1e-5 spreads further, as across a
/// discontinuity, anything within that spread is right, and counted as an edge.
[[nodiscard]] Result<StageReport> check_alone(const evaluate::Program& program, StageKind stage,
                                              const std::vector<Domain>& domains, int count,
                                              std::uint64_t seed);

/// A stage of some hundred operations rounds about as often; errors of either sign cancel as a random walk
/// does, so that the sum of n is about sqrt(n) of one, and four times that is hardly ever passed: 4 * 16.
inline constexpr double kConditionFactor = 64;

}  // namespace gobo::verify
