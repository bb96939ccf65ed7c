#include "lab/verify/alone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "lab/verify/random_points.hpp"

namespace gobo::verify {
namespace {

/// Both evaluations of all points, and how far they may be apart.
struct Evaluations {
    evaluate::Invocations invocations;
    evaluate::Outputs in_float;
    evaluate::Outputs in_double;
    NamedValues by_rounding;
    NamedValues by_edge;
};

Result<Evaluations> evaluate_all(const evaluate::Program& program, const std::vector<Domain>& domains,
                                 std::size_t count, std::uint64_t seed) {
    Evaluations all;
    all.invocations = draw_points(program, domains, count, seed);
    GOBO_TRY(all.in_float, evaluate::run<float>(program, all.invocations));
    GOBO_TRY(all.in_double, evaluate::run<double>(program, all.invocations));
    std::vector<evaluate::Port> ports = program.inputs;
    ports.insert(ports.end(), program.uniforms.begin(), program.uniforms.end());
    const auto in_double = [&](const evaluate::Invocations& invocations) -> Result<NamedValues> {
        GOBO_TRY(auto outputs, evaluate::run<double>(program, invocations));
        return std::move(outputs.values);
    };
    const auto spread_by = [&](double step) {
        return spread(ports, all.invocations, all.in_double.values, step, seed, in_double);
    };
    GOBO_TRY(all.by_rounding, spread_by(kRoundingStep));
    GOBO_TRY(all.by_edge, spread_by(kEdgeStep));
    return all;
}

/// The worst component of one point, and whether only an edge explains it.
struct Judgement {
    std::optional<Failure> failure;
    double ratio = 0;
    double of_largest = 0;  ///< error relative to the output's largest component
    bool is_edge = false;
};

Judgement judge(const Evaluations& all, std::size_t index) {
    Judgement result;
    const std::size_t count = all.in_double.count;
    for (const auto& [name, values] : all.in_double.values) {
        const std::vector<double>& in_float = all.in_float.values.at(name);
        const std::size_t components = values.size() / count;
        double size = 0;
        for (std::size_t c = 0; c < components; ++c)
            size = std::max(size, std::abs(values[c * count + index]));
        for (std::size_t c = 0; c < components; ++c) {
            const std::size_t k = c * count + index;
            const double error = std::abs(in_float[k] - values[k]);
            const double limit =
                kConditionFactor * (all.by_rounding.at(name)[k] + kRoundingStep * size) +
                static_cast<double>(std::numeric_limits<float>::min());  // below it floats lose digits
            if (error <= limit || in_float[k] == values[k]) {
                result.ratio = std::max(result.ratio, error / limit);
                if (size > 0) result.of_largest = std::max(result.of_largest, error / size);
            } else if (error <= 2 * all.by_edge.at(name)[k]) {
                result.is_edge = true;
            } else {
                result.failure = Failure{StageKind::vertex,
                                         Precision::fp32,
                                         name,
                                         static_cast<std::uint32_t>(c),
                                         values[k],
                                         in_float[k],
                                         limit,
                                         error / limit,
                                         {}};
            }
        }
    }
    return result;
}

}  // namespace

Result<StageReport> check_alone(const evaluate::Program& program, StageKind stage,
                                const std::vector<Domain>& domains, int count, std::uint64_t seed) {
    GOBO_TRY(const Evaluations all, evaluate_all(program, domains, static_cast<std::size_t>(count), seed));
    StageReport report;
    report.figures.points = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < report.figures.points; ++i) {
        Judgement judgement = judge(all, i);
        if (judgement.is_edge) ++report.figures.edges;
        Figures& figures = report.figures;
        figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, judgement.ratio);
        figures.largest_fp32_error = std::max(figures.largest_fp32_error, judgement.of_largest);
        if (!judgement.failure) continue;
        judgement.failure->stage = stage;
        judgement.failure->point = evaluate::point_of(program, all.invocations, i);
        ++report.failed_points;
        report.add(std::move(*judgement.failure));
    }
    return report;
}

}  // namespace gobo::verify
