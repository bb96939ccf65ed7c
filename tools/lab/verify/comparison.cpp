#include "lab/verify/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/verify/inputs.hpp"

namespace gobo::verify {
namespace {

/// More questions than this near their edges at one point do not happen; the sides of so many are tried.
constexpr int kMostOpen = 6;

/// How far outputs are out.
struct Deviation {
    Failure worst;          ///< the component that is furthest out, measured by its tolerance
    double of_largest = 0;  ///< error relative to the largest term, over all components
};

double ratio_of(double error, double limit) {
    if (error == 0) return 0;
    return error <= std::numeric_limits<double>::max() && limit > 0 ? error / limit
                                                                    : std::numeric_limits<double>::infinity();
}

void compare(const Expected& expected, std::uint32_t component, double actual, Deviation& deviation) {
    Failure& worst = deviation.worst;
    const double error = std::abs(actual - expected.value[component]);
    const double tolerance = worst.precision == Precision::fp64
                                 ? kDoubleTolerance * expected.largest[component]
                                 : expected.float_error[component];
    const double ratio = ratio_of(error, tolerance);
    deviation.of_largest = std::max(deviation.of_largest, ratio_of(error, expected.largest[component]));
    if (ratio <= worst.ratio) return;
    worst = {worst.stage, worst.precision, expected.output, component, expected.value[component],
             actual,      tolerance,       ratio,           {}};
}

Deviation deviation_of(const std::vector<Expected>& all, const evaluate::Outputs& outputs, std::size_t index,
                       StageKind stage, Precision precision) {
    Deviation deviation;
    deviation.worst.stage = stage;
    deviation.worst.precision = precision;
    for (const Expected& expected : all) {
        if (expected.output == kDiscard) compare(expected, 0, outputs.discarded[index] ? 1 : 0, deviation);
        const auto found = outputs.values.find(expected.output);
        if (found == outputs.values.end()) continue;
        for (std::uint32_t c = 0; c < expected.components; ++c)
            compare(expected, c, found->second[c * outputs.count + index], deviation);
    }
    return deviation;
}

}  // namespace

std::vector<Expected> StageCheck::judge(Precision precision, const Sample& sample,
                                        const evaluate::Invocations& invocations,
                                        const evaluate::Outputs& outputs, std::size_t index,
                                        std::size_t point) {
    oracle::Decisions decisions;
    std::vector<Expected> expected = expect(model_, stage_, sample, decisions);
    Deviation least = deviation_of(expected, outputs, index, stage_, precision);
    Failure plain = least.worst;
    if (decisions.open() > 0) at_edge_[point] = true;
    const std::uint32_t sides = 1U << std::min(decisions.open(), kMostOpen);
    for (std::uint32_t flipped = 1; flipped < sides && least.worst.ratio > 1; ++flipped) {
        oracle::Decisions other(flipped);
        std::vector<Expected> there = expect(model_, stage_, sample, other);
        Deviation deviated = deviation_of(there, outputs, index, stage_, precision);
        if (deviated.worst.ratio >= least.worst.ratio) continue;
        least = std::move(deviated);
        expected = std::move(there);
    }
    Figures& figures = report_.figures;
    const bool is_double = precision == Precision::fp64;
    double& largest = is_double ? figures.largest_fp64_error : figures.largest_fp32_error;
    largest = std::max(largest, least.of_largest);
    if (!is_double) figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, least.worst.ratio);
    if (least.worst.ratio <= 1) return expected;
    failed_[point] = true;
    plain.point = evaluate::point_of(program_, invocations, index);
    report_.add(std::move(plain));
    return expected;
}

Result<StageCheck::Judged> StageCheck::run(Precision precision, std::span<const Sample> samples,
                                           const evaluate::Invocations& invocations,
                                           const std::vector<std::size_t>& own) {
    Judged judged;
    GOBO_TRY(judged.outputs, precision == Precision::fp64 ? evaluate::run<double>(program_, invocations)
                                                          : evaluate::run<float>(program_, invocations));
    for (std::size_t i = 0; i < failed_.size(); ++i) {
        const std::size_t index = own.empty() ? i : own[i];
        judged.expected = judge(precision, samples[index], invocations, judged.outputs, index, i);
    }
    return judged;
}

StageReport StageCheck::report() && {
    const auto marked = [](const std::vector<bool>& marks) {
        return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
    };
    report_.figures.points = failed_.size();
    report_.figures.edges = marked(at_edge_);
    report_.failed_points = marked(failed_);
    return std::move(report_);
}

Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                         const oracle::Model& model, int count, std::uint64_t seed) {
    const std::vector<Sample> exact = make_samples(model, stage, count, seed);
    StageCheck check(program, stage, model, exact.size());
    for (const Precision precision : {Precision::fp64, Precision::fp32}) {
        const std::vector<Sample> samples = precision == Precision::fp64 ? exact : rounded_to_float(exact);
        GOBO_TRY(const auto invocations, bind_inputs(program, samples));
        GOBO_TRY_DO(check.run(precision, samples, invocations));
    }
    return std::move(check).report();
}

}  // namespace gobo::verify
