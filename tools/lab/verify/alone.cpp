#include "lab/verify/alone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "lab/verify/random_points.hpp"

namespace gobo::verify {
namespace {

constexpr int kMoves = 6;  // each input goes either way in some of them
constexpr double kRounding = 0x1p-24;
constexpr double kEdge = 1e-5;

/// How far the outputs move with the inputs.
Result<std::map<std::string, std::vector<double>>> spread(const evaluate::Program& program,
                                                          const evaluate::Invocations& base,
                                                          const evaluate::Outputs& outputs, double step,
                                                          std::uint64_t seed) {
    std::vector<evaluate::Port> ports = program.inputs;
    ports.insert(ports.end(), program.uniforms.begin(), program.uniforms.end());
    std::map<std::string, std::vector<double>> result;
    for (int i = 0; i < kMoves; ++i) {
        const Result<evaluate::Outputs> other =
            evaluate::run<double>(program, moved(ports, base, step, seed + static_cast<std::uint64_t>(i)));
        if (!other) return tl::unexpected(other.error());
        for (const auto& [name, values] : outputs.values) {
            std::vector<double>& widest = result[name];
            widest.resize(values.size());
            const std::vector<double>& there = other->values.at(name);
            for (std::size_t k = 0; k < values.size(); ++k)
                widest[k] = std::max(widest[k], std::abs(there[k] - values[k]));
        }
    }
    return result;
}

/// Both evaluations of all points, and how far they may be apart.
struct Evaluations {
    evaluate::Invocations invocations;
    evaluate::Outputs in_float;
    evaluate::Outputs in_double;
    std::map<std::string, std::vector<double>> by_rounding;
    std::map<std::string, std::vector<double>> by_edge;
};

Result<Evaluations> evaluate_all(const evaluate::Program& program, const std::vector<Domain>& domains,
                                 std::size_t count, std::uint64_t seed) {
    evaluate::Invocations invocations = draw_points(program, domains, count, seed);
    Result<evaluate::Outputs> in_float = evaluate::run<float>(program, invocations);
    if (!in_float) return tl::unexpected(in_float.error());
    Result<evaluate::Outputs> in_double = evaluate::run<double>(program, invocations);
    if (!in_double) return tl::unexpected(in_double.error());
    auto by_rounding = spread(program, invocations, *in_double, kRounding, seed);
    if (!by_rounding) return tl::unexpected(by_rounding.error());
    auto by_edge = spread(program, invocations, *in_double, kEdge, seed);
    if (!by_edge) return tl::unexpected(by_edge.error());
    return Evaluations{std::move(invocations), std::move(*in_float), std::move(*in_double),
                       std::move(*by_rounding), std::move(*by_edge)};
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
        const std::size_t components = values.size() / count;
        double size = 0;
        for (std::size_t c = 0; c < components; ++c)
            size = std::max(size, std::abs(values[c * count + index]));
        for (std::size_t c = 0; c < components; ++c) {
            const std::size_t k = c * count + index;
            const double error = std::abs(all.in_float.values.at(name)[k] - values[k]);
            const double limit =
                kConditionFactor * (all.by_rounding.at(name)[k] + kRounding * size) +
                static_cast<double>(std::numeric_limits<float>::min());  // below it floats lose digits
            if (error <= limit || all.in_float.values.at(name)[k] == values[k]) {
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
                                         all.in_float.values.at(name)[k],
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
    const Result<Evaluations> all = evaluate_all(program, domains, static_cast<std::size_t>(count), seed);
    if (!all) return tl::unexpected(all.error());
    StageReport report;
    report.figures.points = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < report.figures.points; ++i) {
        Judgement judgement = judge(*all, i);
        if (judgement.is_edge) ++report.figures.edges;
        Figures& figures = report.figures;
        figures.largest_fp32_ratio = std::max(figures.largest_fp32_ratio, judgement.ratio);
        figures.largest_fp32_error = std::max(figures.largest_fp32_error, judgement.of_largest);
        if (!judgement.failure) continue;
        judgement.failure->stage = stage;
        judgement.failure->point = evaluate::point_of(program, all->invocations, i);
        ++report.failed_points;
        add_failure(report, std::move(*judgement.failure));
    }
    return report;
}

}  // namespace gobo::verify
