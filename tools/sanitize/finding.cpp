#include "sanitize/finding.hpp"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gobo::sanitize {
namespace {

std::map<std::string, std::vector<double>> values_of(const std::vector<evaluate::Port>& ports,
                                                     const evaluate::Invocations& invocations,
                                                     std::size_t index) {
    std::map<std::string, std::vector<double>> result;
    for (const evaluate::Port& port : ports) {
        const auto found = invocations.values.find(port.name);
        if (found == invocations.values.end()) continue;
        const bool is_common = found->second.size() == port.components;
        for (std::size_t component = 0; component < port.components; ++component)
            result[port.name].push_back(
                found->second[is_common ? component : component * invocations.count + index]);
    }
    return result;
}

/// As short as reads back as the same float, where it is one.
std::string number_text(double number) {
    const auto as_float = static_cast<float>(number);
    return static_cast<double>(as_float) == number ? fmt::format("{}", as_float) : fmt::format("{}", number);
}

std::string toml_table(std::string_view name, const std::map<std::string, std::vector<double>>& values) {
    if (values.empty()) return {};
    std::string text = fmt::format("\n[{}]\n", name);
    for (const auto& [key, numbers] : values) {
        std::vector<std::string> texts;
        for (const double number : numbers) texts.push_back(number_text(number));
        const std::string list = fmt::format("{}", fmt::join(texts, ", "));
        text += numbers.size() == 1 ? fmt::format("\"{}\" = {}\n", key, list)
                                    : fmt::format("\"{}\" = [{}]\n", key, list);
    }
    return text;
}

}  // namespace

Point point_of(const evaluate::Program& program, const evaluate::Invocations& invocations,
               std::size_t index) {
    Point point{
        values_of(program.inputs, invocations, index), values_of(program.uniforms, invocations, index), {}};
    evaluate::ImageRequest request;
    request.invocation = index;
    for (const evaluate::ImagePort& image : program.images) {
        const auto given = invocations.images.find(image.name);
        if (given == invocations.images.end()) continue;
        const std::array<double, 4> texel = given->second(request);
        point.samplers[image.name].assign(texel.begin(), texel.end());
    }
    return point;
}

std::string to_text(const Finding& finding) {
    std::string text = finding.message;
    if (!finding.operation.empty()) text += ": " + finding.operation;
    if (finding.machine != Machine::ieee) text += fmt::format(", machine {}", name_of(finding.machine));
    return text;
}

std::string eval_input(const Finding& finding, const std::string& heading) {
    return fmt::format(
        "# {}\n# {}:{}: {}\nstage = \"{}\"\n{}{}{}", heading, finding.place.file, finding.place.line,
        to_text(finding), gobo::name_of(finding.stage), toml_table("inputs", finding.point.inputs),
        toml_table("uniforms", finding.point.uniforms), toml_table("samplers", finding.point.samplers));
}

}  // namespace gobo::sanitize
