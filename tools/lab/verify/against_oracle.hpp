// A stage of `lit` against the oracle.
#pragma once

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/model.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

/// Evaluates the stage at `count` samples, as fp64 where they are and as fp32 where their floats are, and
/// compares every output with the oracle's answer for the same numbers.
[[nodiscard]] Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                                       const oracle::Model& model, int count,
                                                       std::uint64_t seed);

}  // namespace gobo::verify
