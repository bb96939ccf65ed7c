#include "verify/report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gobo::verify {
namespace {

/// A number as TOML writes it: shortest decimal that reads back the same; infinities and NaN by name.
std::string toml_number(double number) {
    return fmt::format("{}", number);
}

std::string toml_value(const std::vector<double>& numbers) {
    if (numbers.size() == 1) return toml_number(numbers.front());
    std::vector<std::string> texts;
    texts.reserve(numbers.size());
    for (const double number : numbers) texts.push_back(toml_number(number));
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string toml_table(std::string_view name, const std::map<std::string, std::vector<double>>& values) {
    std::string text = fmt::format("\n[{}]\n", name);
    for (const auto& [key, numbers] : values) text += fmt::format("\"{}\" = {}\n", key, toml_value(numbers));
    return text;
}

}  // namespace

std::string_view name_of(Precision precision) {
    return precision == Precision::fp32 ? "fp32" : "fp64";
}

Figures& Figures::operator+=(const Figures& other) {
    points += other.points;
    edges += other.edges;
    largest_fp64_error = std::max(largest_fp64_error, other.largest_fp64_error);
    largest_fp32_error = std::max(largest_fp32_error, other.largest_fp32_error);
    largest_fp32_ratio = std::max(largest_fp32_ratio, other.largest_fp32_ratio);
    return *this;
}

void add_failure(StageReport& report, Failure failure) {
    const auto place = std::find_if(report.worst.begin(), report.worst.end(),
                                    [&](const Failure& other) { return other.ratio < failure.ratio; });
    report.worst.insert(place, std::move(failure));
    if (report.worst.size() > kWorstPoints) report.worst.pop_back();
}

PointInputs point_inputs(const evaluate::Program& program, const evaluate::Invocations& invocations,
                         std::size_t index) {
    const auto values_of = [&](const std::vector<evaluate::Port>& ports) {
        std::map<std::string, std::vector<double>> result;
        for (const evaluate::Port& port : ports) {
            const auto found = invocations.values.find(port.name);
            if (found == invocations.values.end()) continue;
            for (std::size_t c = 0; c < port.components; ++c)
                result[port.name].push_back(found->second[c * invocations.count + index]);
        }
        return result;
    };
    return {values_of(program.inputs), values_of(program.uniforms)};
}

std::string to_text(const Failure& failure) {
    return fmt::format("{} {}[{}] is {}, should be {} within {:.3g}", name_of(failure.precision),
                       failure.output, failure.component, failure.actual, failure.expected,
                       failure.tolerance);
}

std::string eval_input(const Failure& failure, const std::string& key) {
    return eval_input(failure.stage, failure.point, fmt::format("# {}: {}\n", key, to_text(failure)));
}

std::string eval_input(StageKind stage, const PointInputs& point, const std::string& comment) {
    return fmt::format("{}stage = \"{}\"\n{}{}", comment, gobo::name_of(stage),
                       toml_table("inputs", point.inputs), toml_table("uniforms", point.uniforms));
}

}  // namespace gobo::verify
