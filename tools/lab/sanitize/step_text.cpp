#include "lab/sanitize/step_text.hpp"

#include <span>
#include <vector>

#include <fmt/ranges.h>

#include "lab/evaluate/eval_report.hpp"
#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using Step = evaluate::Step<float>;

/// "depth = 0", "(1, 0.5, 0.25)".
std::string value_text(const Step& step, const evaluate::Slice& slice, std::size_t lane) {
    std::vector<double> components;
    for (std::uint32_t component = 0; component < slice.count; ++component)
        components.push_back(step.value(slice, component, lane));
    const std::string numbers = evaluate::to_text(components);
    const std::string& name = step.program.names[slice.name];
    return name.empty() ? numbers : fmt::format("{} = {}", name, numbers);
}

/// Of a store whose place each lane computes: the variable's own slots are not what was written.
bool is_scatter(const Step& step) {
    return step.row().code == evaluate::kScatter;
}

}  // namespace

std::string operands_text(const Step& step, std::size_t lane) {
    const auto& slices = step.info().operands;
    std::vector<std::string> operands;
    for (const evaluate::Slice& slice : std::span(slices).first(is_scatter(step) ? 1 : slices.size()))
        if (slice.count > 0) operands.push_back(value_text(step, slice, lane));
    return fmt::format("{} {}", step.name(), fmt::join(operands, ", "));
}

std::string result_text(const Step& step, std::size_t lane) {
    return value_text(step, step.info().result, lane);
}

std::string operation_text(const Step& step, std::size_t lane) {
    if (is_scatter(step))
        return fmt::format("{} in {}", operands_text(step, lane),
                           step.program.names[step.info().result.name]);
    return fmt::format("{} -> {}", operands_text(step, lane), result_text(step, lane));
}

}  // namespace gobo::sanitize
