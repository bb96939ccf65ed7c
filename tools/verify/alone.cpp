#include "verify/alone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "verify/random.hpp"

namespace gobo::verify {
namespace {

constexpr double kLargestOrdinary = 1e3;
constexpr int kMoves = 6;  // each input goes either way in some of them
constexpr double kRounding = 0x1p-24;
constexpr double kEdge = 1e-5;

/// "PointLights.lights[2].color" as domains name it: "PointLights.lights[].color".
std::string without_subscripts(const std::string& name) {
    std::string result;
    bool is_inside = false;
    for (const char character : name) {
        if (character == ']') is_inside = false;
        if (!is_inside) result += character;
        if (character == '[') is_inside = true;
    }
    return result;
}

/// Draws values of ports.
class Drawer {
  public:
    Drawer(const std::vector<Domain>& domains, std::uint64_t seed) : domains_(domains), random_(seed) {}

    /// The values of one port for all invocations, as floats hold them.
    std::vector<double> draw(const evaluate::Port& port, std::size_t count) {
        std::vector<double> values(port.components * count);
        const auto domain =
            std::find_if(domains_.begin(), domains_.end(),
                         [name = without_subscripts(port.name)](const Domain& d) { return d.name == name; });
        for (std::size_t i = 0; i < count; ++i) {
            const double scale = domain != domains_.end() && domain->of_length ? length(*domain, port) : 1;
            for (std::size_t c = 0; c < port.components; ++c) {
                double value = domain != domains_.end() && !domain->of_length
                                   ? component(domain->low, domain->high)
                                   : scale * component(-1, 1);
                if (port.name == "gl_FragCoord") value = c < 2 ? random_.whole(0, 63) + 0.5 : random_.unit();
                if (port.scalar != evaluate::Scalar::real) value = std::floor(value);
                if (port.scalar == evaluate::Scalar::boolean) value = random_.whole(0, 1);
                values[c * count + i] = static_cast<float>(value);
            }
        }
        return values;
    }

  private:
    /// Vectors whose length is bounded: components that give about such a length.
    double length(const Domain& domain, const evaluate::Port& port) {
        return component(domain.low, domain.high) / std::sqrt(static_cast<double>(port.components) / 3);
    }

    /// Half of them spread evenly, half over the powers of ten.
    double component(double low, double high) {
        low = std::max(low, -kLargestOrdinary);
        high = std::clamp(high, low, kLargestOrdinary);
        if (high <= 0 || random_.one_in(2)) return random_.between(low, high);
        const double size = random_.across(std::max(low, high * 1e-4), high);
        return low < 0 && random_.one_in(2) ? std::max(-size, low) : size;
    }

    const std::vector<Domain>& domains_;
    Random random_;
};

evaluate::Invocations draw_invocations(const evaluate::Program& program, const std::vector<Domain>& domains,
                                       std::size_t count, std::uint64_t seed) {
    Drawer drawer(domains, seed);
    evaluate::Invocations invocations;
    invocations.count = count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) invocations.values[port.name] = drawer.draw(port, count);
    // A smooth picture, the same in every texture: one that has no texels has no edges.
    const evaluate::Image smooth = [](const evaluate::ImageRequest& request) {
        const double x = request.coordinates[0];
        const double y = request.coordinates[1];
        return std::array<double, 4>{0.5 + 0.5 * std::sin(x), 0.5 + 0.5 * std::cos(y), 0.5, 1};
    };
    for (const evaluate::ImagePort& image : program.images) invocations.images[image.name] = smooth;
    return invocations;
}

/// The inputs that are reals, each moved up or down by `step` relative to itself.
evaluate::Invocations moved(const evaluate::Program& program, const evaluate::Invocations& base, double step,
                            std::uint64_t seed) {
    Random random(seed);
    evaluate::Invocations result = base;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            if (port.scalar != evaluate::Scalar::real) continue;
            for (double& value : result.values[port.name]) value *= random.one_in(2) ? 1 + step : 1 - step;
        }
    return result;
}

/// How far the outputs move with the inputs.
Result<std::map<std::string, std::vector<double>>> spread(const evaluate::Program& program,
                                                          const evaluate::Invocations& base,
                                                          const evaluate::Outputs& outputs, double step,
                                                          std::uint64_t seed) {
    std::map<std::string, std::vector<double>> result;
    for (int i = 0; i < kMoves; ++i) {
        const Result<evaluate::Outputs> other =
            evaluate::run<double>(program, moved(program, base, step, seed + static_cast<std::uint64_t>(i)));
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
    evaluate::Invocations invocations = draw_invocations(program, domains, count, seed);
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
        report.figures.largest_fp32_ratio = std::max(report.figures.largest_fp32_ratio, judgement.ratio);
        if (!judgement.failure) continue;
        judgement.failure->stage = stage;
        judgement.failure->point = point_inputs(program, all->invocations, i);
        ++report.failed_points;
        add_failure(report, std::move(*judgement.failure));
    }
    return report;
}

}  // namespace gobo::verify
