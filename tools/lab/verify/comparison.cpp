#include "lab/verify/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gobo::verify {
namespace {

/// More questions than this near their edges at one point do not happen; the sides of so many are tried.
constexpr int kMostOpen = 6;

/// The component that is furthest out, measured by its tolerance.
struct Deviation {
    double ratio = 0;
    double of_largest = 0;  ///< error relative to the largest term, over all components
    std::string output;
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

Deviation deviation(const std::vector<Expected>& all, const evaluate::Outputs& outputs, std::size_t index,
                    Precision precision) {
    Deviation worst;
    for (const Expected& expected : all) {
        if (expected.output == kDiscard) {
            const double is_discarded = outputs.discarded[index] ? 1 : 0;
            compare(expected, {is_discarded}, 1, 0, precision, worst);
            continue;
        }
        const auto found = outputs.values.find(expected.output);
        if (found != outputs.values.end())
            compare(expected, found->second, outputs.count, index, precision, worst);
    }
    return worst;
}

std::size_t count_of(const std::vector<bool>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
}

}  // namespace

Result<evaluate::Outputs> Comparison::run(const evaluate::Invocations& invocations) const {
    return precision_ == Precision::fp64 ? evaluate::run<double>(program_, invocations)
                                         : evaluate::run<float>(program_, invocations);
}

std::vector<Expected> Comparison::judge(const Sample& sample, const evaluate::Invocations& invocations,
                                        const evaluate::Outputs& outputs, std::size_t index, Marks& marks,
                                        std::size_t mark) {
    oracle::Decisions decisions;
    std::vector<Expected> expected = expect(model_, stage_, sample, decisions);
    const Deviation plain = deviation(expected, outputs, index, precision_);
    Deviation least = plain;
    if (decisions.open() > 0) marks.at_edge[mark] = true;
    const std::uint32_t sides = 1U << std::min(decisions.open(), kMostOpen);
    for (std::uint32_t flipped = 1; flipped < sides && least.ratio > 1; ++flipped) {
        oracle::Decisions other(flipped);
        std::vector<Expected> there = expect(model_, stage_, sample, other);
        const Deviation deviated = deviation(there, outputs, index, precision_);
        if (deviated.ratio >= least.ratio) continue;
        least = deviated;
        expected = std::move(there);
    }
    note_largest(least.of_largest, least.ratio);
    if (least.ratio <= 1) return expected;
    marks.failed[mark] = true;
    add_failure(report_, {stage_, precision_, plain.output, plain.component, plain.expected, plain.actual,
                          plain.tolerance, plain.ratio, evaluate::point_of(program_, invocations, index)});
    return expected;
}

void Comparison::note_largest(double error, double ratio) {
    Figures& figures = report_.figures;
    double& largest = precision_ == Precision::fp64 ? figures.largest_fp64_error : figures.largest_fp32_error;
    largest = std::max(largest, error);
    if (precision_ == Precision::fp32)
        figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, ratio);
}

void count(const Marks& marks, StageReport& report) {
    report.figures.points += marks.failed.size();
    report.figures.edges += count_of(marks.at_edge);
    report.failed_points += count_of(marks.failed);
}

}  // namespace gobo::verify
