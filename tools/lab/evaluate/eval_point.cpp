#include "lab/evaluate/eval_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gobo::evaluate {
namespace {

using Numbers = std::map<std::string, std::vector<double>>;

Numbers values_of(const std::vector<Port>& ports, const Invocations& invocations, std::size_t index) {
    Numbers result;
    for (const Port& port : ports) {
        const auto found = invocations.values.find(port.name);
        if (found == invocations.values.end()) continue;
        const bool is_common = found->second.size() == port.components;
        for (std::size_t component = 0; component < port.components; ++component)
            result[port.name].push_back(
                found->second[is_common ? component : component * invocations.count + index]);
    }
    return result;
}

/// The shortest decimal that reads back the same, as TOML writes it; infinities and NaN by name.
std::string number_text(double number, Digits digits) {
    const auto as_float = static_cast<float>(number);
    const bool is_float = digits == Digits::of_float && static_cast<double>(as_float) == number;
    return is_float ? fmt::format("{}", as_float) : fmt::format("{}", number);
}

std::string table_text(std::string_view name, const Numbers& values, Digits digits) {
    if (values.empty()) return {};
    std::string text = fmt::format("\n[{}]\n", name);
    for (const auto& [key, numbers] : values) {
        std::vector<std::string> texts;
        for (const double number : numbers) texts.push_back(number_text(number, digits));
        const std::string list = fmt::format("{}", fmt::join(texts, ", "));
        text += numbers.size() == 1 ? fmt::format("\"{}\" = {}\n", key, list)
                                    : fmt::format("\"{}\" = [{}]\n", key, list);
    }
    return text;
}

}  // namespace

EvalPoint point_of(const Program& program, const Invocations& invocations, std::size_t index) {
    EvalPoint point{
        values_of(program.inputs, invocations, index), values_of(program.uniforms, invocations, index), {}};
    for (const ImagePort& port : program.images)
        if (const auto given = invocations.images.find(port.name); given != invocations.images.end())
            add_numbers(port.name, content_of(given->second, port, index), point.samplers);
    return point;
}

std::string eval_file(std::string_view stage, const EvalPoint& point, std::string_view comment,
                      Digits digits) {
    return fmt::format("{}stage = \"{}\"\n{}{}{}", comment, stage, table_text("inputs", point.inputs, digits),
                       table_text("uniforms", point.uniforms, digits),
                       table_text("samplers", point.samplers, digits));
}

}  // namespace gobo::evaluate
