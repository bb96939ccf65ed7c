// Outputs of a stage, point by point, against what the oracle expects of them.
#pragma once

#include <cstddef>
#include <vector>

#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/report.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// What is known of each sample, of either precision.
struct Marks {
    explicit Marks(std::size_t samples) : at_edge(samples), failed(samples) {}
    std::vector<bool> at_edge;
    std::vector<bool> failed;
};

/// Judges one stage's outputs in one precision.
class Comparison {
  public:
    Comparison(const evaluate::Program& program, StageKind stage, const oracle::Model& model,
               Precision precision, StageReport& report)
        : program_(program), stage_(stage), model_(model), precision_(precision), report_(report) {}

    /// Runs the stage for these invocations.
    [[nodiscard]] Result<evaluate::Outputs> run(const evaluate::Invocations& invocations) const;

    /// Judges invocation `index`, which stands for the sample: reports it where it is out of tolerance, and
    /// marks what is known of it at `mark`. At a discontinuity either side is right; the answer is what is
    /// expected on the side that the stage took.
    std::vector<Expected> judge(const Sample& sample, const evaluate::Invocations& invocations,
                                const evaluate::Outputs& outputs, std::size_t index, Marks& marks,
                                std::size_t mark);

  private:
    /// `error` is relative to the largest term, `ratio` to the tolerance.
    void note_largest(double error, double ratio);

    const evaluate::Program& program_;
    StageKind stage_;
    const oracle::Model& model_;
    Precision precision_;
    StageReport& report_;
};

/// Adds up the marks: points, edges, failed points.
void count(const Marks& marks, StageReport& report);

}  // namespace gobo::verify
