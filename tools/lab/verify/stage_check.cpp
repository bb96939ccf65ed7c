#include "lab/verify/stage_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::verify {
namespace {

/// More questions than this near their edges at one point do not happen; the sides of so many are tried.
constexpr int kMostOpen = 6;

/// How far outputs are out.
struct Deviation {
    Failure worst;          ///< the component that is furthest out, measured by its tolerance
    double of_largest = 0;  ///< error relative to the largest term, over all components
};

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

/// The sample with what changes from it to its neighbours, as the evaluation of a quad takes derivatives.
Sample with_steps(std::span<const Sample> samples, std::size_t index) {
    Sample sample = samples[index];
    const std::size_t quad = index - index % 4;
    if (quad + 3 >= samples.size()) return sample;
    const auto step = [&](std::size_t from, std::size_t to) {
        const oracle::SurfacePoint& here = samples[quad + from].surface;
        const oracle::SurfacePoint& there = samples[quad + to].surface;
        return oracle::PixelStep{there.position - here.position, there.normal - here.normal,
                                 there.texture_coordinate - here.texture_coordinate,
                                 there.texture_coordinate1 - here.texture_coordinate1};
    };
    const std::size_t row = index & 2U;
    const std::size_t column = index & 1U;
    sample.surface.along_x = step(row, row + 1);
    sample.surface.along_y = step(column, column + 2);
    return sample;
}

/// Both evaluations of all points, and how far they may be apart.
struct Evaluations {
    NamedValues in_float;
    NamedValues in_double;
    NamedValues by_rounding;
    NamedValues by_edge;
};

/// Judges one point, and keeps its worst component in `failure`; whether only an edge explains it.
bool is_at_edge(const Evaluations& all, std::size_t count, std::size_t index, Figures& figures,
                std::optional<Failure>& failure) {
    bool is_edge = false;
    for (const auto& [name, values] : all.in_double) {
        const std::vector<double>& in_float = all.in_float.at(name);
        const double size = largest_component(values, count, index);
        for (std::size_t k = index; k < values.size(); k += count) {
            if (std::isnan(in_float[k]) && std::isnan(values[k])) continue;  // the sanitizer's to tell
            const double error = std::abs(in_float[k] - values[k]);
            const double limit =
                kConditionFactor * (all.by_rounding.at(name)[k] + kRoundingStep * size) +
                static_cast<double>(std::numeric_limits<float>::min());  // below it floats lose digits
            if (error <= limit || in_float[k] == values[k]) {
                figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, error / limit);
                if (size > 0) figures.largest_fp32_error = std::max(figures.largest_fp32_error, error / size);
            } else if (error <= 2 * all.by_edge.at(name)[k]) {
                is_edge = true;
            } else {
                const auto component = static_cast<std::uint32_t>(k / count);
                failure = Failure{StageKind::vertex, Precision::fp32, name,          component, values[k],
                                  in_float[k],       limit,           error / limit, {}};
            }
        }
    }
    return is_edge;
}

}  // namespace

void StageCheck::weigh_bounds(const std::vector<Expected>& all, const evaluate::Outputs& outputs,
                              std::size_t index, std::size_t point) {
    Large large{point, {}, 0};
    large.component.stage = stage_;
    for (const Expected& expected : all) {
        const auto found = outputs.values.find(expected.output);
        if (found == outputs.values.end()) continue;
        for (std::uint32_t c = 0; c < expected.components; ++c) {
            const double bound = expected.float_error[c];
            if (expected.value[c] != 0 && bound > std::abs(expected.value[c])) {
                vacuous_[point] = true;
                if (bound > kLooseBound * expected.largest[c]) loose_[point] = true;
            }
            const double actual = found->second[c * outputs.count + index];
            const double limit = kConditionFactor * kRoundingStep * expected.largest[c];
            const double ratio = ratio_of(std::abs(actual - expected.value[c]), limit);
            if (ratio <= std::max(1.0, large.component.ratio)) continue;
            large.component = {stage_, Precision::fp32, expected.output, c, expected.value[c],
                               actual, limit,           ratio,           {}};
            large.largest = expected.largest[c];
        }
    }
    if (large.component.ratio > 1 && !at_edge_[point] && !model_.is_known_to_cancel())
        large_.push_back(std::move(large));
}

Result<void> StageCheck::explain_errors(std::span<const Sample> samples) {
    if (large_.empty()) return {};
    // Where derivatives are taken a point comes with its quad.
    const std::size_t each = model_.takes_derivatives() ? 4 : 1;
    std::vector<Sample> chosen;
    for (const Large& large : large_) {
        const auto first = samples.begin() + static_cast<std::ptrdiff_t>(large.point - large.point % each);
        chosen.insert(chosen.end(), first, first + static_cast<std::ptrdiff_t>(each));
    }
    GOBO_TRY(const auto invocations, bind_inputs(program_, chosen));
    GOBO_TRY(const NamedValues exact, in_double(program_, invocations));
    // Inputs are moved so far at once: where a slope is infinite, a step's multiple says nothing.
    constexpr double kStep = kConditionFactor * kRoundingStep;
    constexpr std::array<std::uint64_t, 5> kSeeds = {1, 11, 21, 31, 41};  // either side of an edge is met
    std::vector<NamedValues> spreads;
    for (const std::uint64_t seed : kSeeds) {
        GOBO_TRY(NamedValues widest, spread(program_, invocations, exact, kStep, seed));
        spreads.push_back(std::move(widest));
    }
    for (std::size_t k = 0; k < large_.size(); ++k) {
        const std::size_t i = k * each + large_[k].point % each;
        Failure component = std::move(large_[k].component);
        double by_inputs = 0;
        for (const NamedValues& widest : spreads)
            by_inputs =
                std::max(by_inputs, widest.at(component.output)[component.component * invocations.count + i]);
        component.tolerance = by_inputs + kStep * large_[k].largest;
        component.ratio = ratio_of(std::abs(component.actual - component.expected), component.tolerance);
        if (component.ratio <= 1) continue;
        ++report_.figures.unexplained;
        if (report_.least_explained && report_.least_explained->ratio >= component.ratio) continue;
        component.point = evaluate::point_of(program_, invocations, i);
        report_.least_explained = std::move(component);
    }
    large_.clear();
    return {};
}

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
    if (!is_double) {
        figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, least.worst.ratio);
        weigh_bounds(expected, outputs, index, point);
    }
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
        judged.expected =
            model_.takes_derivatives()
                ? judge(precision, with_steps(samples, index), invocations, judged.outputs, index, i)
                : judge(precision, samples[index], invocations, judged.outputs, index, i);
    }
    return judged;
}

StageReport StageCheck::report() && {
    const auto marked = [](const std::vector<bool>& marks) {
        return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
    };
    report_.figures.points = failed_.size();
    report_.figures.edges = marked(at_edge_);
    report_.figures.vacuous = marked(vacuous_);
    report_.figures.loose = marked(loose_);
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
        if (precision == Precision::fp32) GOBO_TRY_DO(check.explain_errors(samples));
    }
    return std::move(check).report();
}

Result<StageReport> check_alone(const evaluate::Program& program, StageKind stage,
                                const std::vector<Domain>& domains, int count, std::uint64_t seed) {
    StageReport report;
    report.figures.points = static_cast<std::size_t>(count);
    const evaluate::Invocations points = draw_points(program, domains, report.figures.points, seed);
    Evaluations all;
    GOBO_TRY(auto in_float, evaluate::run<float>(program, points));
    all.in_float = std::move(in_float.values);
    GOBO_TRY(all.in_double, in_double(program, points));
    GOBO_TRY(all.by_rounding, spread(program, points, all.in_double, kRoundingStep, seed));
    GOBO_TRY(all.by_edge, spread(program, points, all.in_double, kEdgeStep, seed));
    for (std::size_t i = 0; i < report.figures.points; ++i) {
        std::optional<Failure> failure;
        if (is_at_edge(all, report.figures.points, i, report.figures, failure)) ++report.figures.edges;
        if (!failure) continue;
        failure->stage = stage;
        failure->point = evaluate::point_of(program, points, i);
        ++report.failed_points;
        report.add(std::move(*failure));
    }
    return report;
}

}  // namespace gobo::verify
