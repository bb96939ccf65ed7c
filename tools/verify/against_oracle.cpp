#include "verify/against_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/expectation.hpp"
#include "verify/feed.hpp"
#include "verify/sample.hpp"

namespace gobo::verify {
namespace {

/// More questions than this near their edges at one point do not happen; the sides of so many are tried.
constexpr int kMostOpen = 6;

/// The component that is furthest out, measured by its tolerance.
struct Deviation {
    double ratio = 0;
    double of_largest = 0;  ///< error relative to the largest term, over all components
    std::string_view output;
    std::uint32_t component = 0;
    double expected = 0;
    double actual = 0;
    double tolerance = 0;
};

double ratio_of(double error, double limit) {
    if (error == 0) return 0;
    return error <= std::numeric_limits<double>::max() && limit > 0 ? error / limit
                                                                    : std::numeric_limits<double>::infinity();
}

void compare(const Expected& expected, const std::vector<double>& actual, std::size_t count,
             std::size_t index, Precision precision, Deviation& worst) {
    for (std::uint32_t c = 0; c < expected.components; ++c) {
        const double value = actual[c * count + index];
        const double error = std::abs(value - expected.value[c]);
        const double tolerance =
            precision == Precision::fp64 ? kDoubleTolerance * expected.largest[c] : expected.float_error[c];
        const double ratio = ratio_of(error, tolerance);
        worst.of_largest = std::max(worst.of_largest, ratio_of(error, expected.largest[c]));
        if (ratio > worst.ratio) {
            worst = {ratio, worst.of_largest, expected.output, c, expected.value[c], value, tolerance};
        }
    }
}

/// What is known of each sample, of either precision.
struct Marks {
    std::vector<bool> at_edge;
    std::vector<bool> failed;
};

std::size_t count_of(const std::vector<bool>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
}

/// Compares one precision's outputs at all samples.
class Comparison {
  public:
    Comparison(const evaluate::Program& program, StageKind stage, const oracle::Model& model,
               Precision precision, StageReport& report)
        : program_(program), stage_(stage), model_(model), precision_(precision), report_(report) {}

    Result<bool> run(std::span<const Sample> samples, Marks& marks) {
        const Result<evaluate::Invocations> invocations = feed(program_, samples);
        if (!invocations) return tl::unexpected(invocations.error());
        const Result<evaluate::Outputs> outputs = precision_ == Precision::fp64
                                                      ? evaluate::run<double>(program_, *invocations)
                                                      : evaluate::run<float>(program_, *invocations);
        if (!outputs) return tl::unexpected(outputs.error());
        for (std::size_t i = 0; i < samples.size(); ++i) judge(samples[i], *invocations, *outputs, i, marks);
        return true;
    }

  private:
    void judge(const Sample& sample, const evaluate::Invocations& invocations,
               const evaluate::Outputs& outputs, std::size_t index, Marks& marks) {
        oracle::Decisions decisions;
        const Deviation plain = deviation(sample, outputs, index, decisions);
        Deviation least = plain;
        if (decisions.open() > 0) marks.at_edge[index] = true;
        const std::uint32_t sides = 1U << std::min(decisions.open(), kMostOpen);
        for (std::uint32_t flipped = 1; flipped < sides && least.ratio > 1; ++flipped) {
            oracle::Decisions other(flipped);
            const Deviation deviated = deviation(sample, outputs, index, other);
            if (deviated.ratio < least.ratio) least = deviated;
        }
        double& largest = precision_ == Precision::fp64 ? report_.figures.largest_fp64_error
                                                        : report_.figures.largest_fp32_ratio;
        largest = std::max(largest, precision_ == Precision::fp64 ? least.of_largest : least.ratio);
        if (least.ratio <= 1) return;
        marks.failed[index] = true;
        add_failure(report_,
                    {stage_, precision_, std::string(plain.output), plain.component, plain.expected,
                     plain.actual, plain.tolerance, plain.ratio, point_inputs(program_, invocations, index)});
    }

    Deviation deviation(const Sample& sample, const evaluate::Outputs& outputs, std::size_t index,
                        oracle::Decisions& decisions) const {
        Deviation worst;
        for (const Expected& expected : expect(model_, stage_, sample, decisions)) {
            const auto found = outputs.values.find(expected.output);
            if (found != outputs.values.end())
                compare(expected, found->second, outputs.count, index, precision_, worst);
        }
        return worst;
    }

    const evaluate::Program& program_;
    StageKind stage_;
    const oracle::Model& model_;
    Precision precision_;
    StageReport& report_;
};

}  // namespace

Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                         const oracle::Model& model, int count, std::uint64_t seed) {
    const std::vector<Sample> exact = make_samples(model, stage, count, seed);
    std::vector<Sample> rounded;
    rounded.reserve(exact.size());
    for (const Sample& sample : exact) rounded.push_back(rounded_to_float(sample));
    StageReport report;
    Marks marks{std::vector<bool>(exact.size()), std::vector<bool>(exact.size())};
    const Result<bool> in_double =
        Comparison(program, stage, model, Precision::fp64, report).run(exact, marks);
    if (!in_double) return tl::unexpected(in_double.error());
    const Result<bool> in_float =
        Comparison(program, stage, model, Precision::fp32, report).run(rounded, marks);
    if (!in_float) return tl::unexpected(in_float.error());
    report.figures.points = exact.size();
    report.figures.edges = count_of(marks.at_edge);
    report.failed_points = count_of(marks.failed);
    return report;
}

}  // namespace gobo::verify
