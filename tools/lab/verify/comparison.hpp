// Outputs of a stage, point by point, against what the oracle expects of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/report.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// One stage judged at a number of points, in one precision after the other.
class StageCheck {
  public:
    StageCheck(const evaluate::Program& program, StageKind stage, const oracle::Model& model,
               std::size_t points)
        : program_(program), stage_(stage), model_(model), at_edge_(points), failed_(points) {}

    struct Judged {
        evaluate::Outputs outputs;
        std::vector<Expected> expected;  ///< at the last point
    };
    /// Runs the stage for the invocations that the samples stand for, and judges each point: number i is
    /// invocation own[i], or i where `own` is empty. At a discontinuity either side is right; the answer is
    /// what is expected on the side that the stage took.
    [[nodiscard]] Result<Judged> run(Precision precision, std::span<const Sample> samples,
                                     const evaluate::Invocations& invocations,
                                     const std::vector<std::size_t>& own = {});

    /// Of all runs; a point counts as failed, or at an edge, where it was so in any of them.
    [[nodiscard]] StageReport report() &&;

  private:
    std::vector<Expected> judge(Precision precision, const Sample& sample,
                                const evaluate::Invocations& invocations, const evaluate::Outputs& outputs,
                                std::size_t index, std::size_t point);

    const evaluate::Program& program_;
    StageKind stage_;
    const oracle::Model& model_;
    std::vector<bool> at_edge_;
    std::vector<bool> failed_;
    StageReport report_;
};

/// Evaluates the stage at `count` samples, as fp64 where they are and as fp32 where their floats are, and
/// compares every output with the oracle's answer for the same numbers.
[[nodiscard]] Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                                       const oracle::Model& model, int count,
                                                       std::uint64_t seed);

}  // namespace gobo::verify
