// Outputs of a stage, point by point: against what the oracle expects of them or, where it knows nothing,
// fp32 against fp64.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "family/family.hpp"
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
        : program_(program),
          stage_(stage),
          model_(model),
          at_edge_(points),
          failed_(points),
          vacuous_(points),
          loose_(points) {}

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

    /// Of the last run, in fp32, with these samples: whether roundings of the inputs explain each error that
    /// is larger than kConditionFactor roundings of the largest term.
    [[nodiscard]] Result<void> explain_errors(std::span<const Sample> samples);

    /// Of all runs; a point counts as failed, or at an edge, where it was so in any of them.
    [[nodiscard]] StageReport report() &&;

  private:
    void weigh_bounds(const std::vector<Expected>& all, const evaluate::Outputs& outputs, std::size_t index,
                      std::size_t point);
    std::vector<Expected> judge(Precision precision, const Sample& sample,
                                const evaluate::Invocations& invocations, const evaluate::Outputs& outputs,
                                std::size_t index, std::size_t point);

    const evaluate::Program& program_;
    StageKind stage_;
    const oracle::Model& model_;
    std::vector<bool> at_edge_;
    std::vector<bool> failed_;
    std::vector<bool> vacuous_;
    std::vector<bool> loose_;
    /// A point with a large error, and the component that has it.
    struct Large {
        std::size_t point = 0;
        Failure component;
        double largest = 0;
    };
    std::vector<Large> large_;
    StageReport report_;
};

/// Evaluates the stage at `count` samples, as fp64 where they are and as fp32 where their floats are, and
/// compares every output with the oracle's answer for the same numbers.
[[nodiscard]] Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                                       const oracle::Model& model, int count,
                                                       std::uint64_t seed);

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
