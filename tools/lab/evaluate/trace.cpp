#include "lab/evaluate/trace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gobo::evaluate {

template <class T>
TracedValue Trace<T>::value_of(const Step<T>& step, const Slice& slice, std::size_t lane) const {
    TracedValue value{step.program.names[slice.name], {}};
    for (std::uint32_t component = 0; component < slice.count; ++component)
        value.components.push_back(step.value(slice, component, lane));
    return value;
}

template <class T>
void Trace<T>::after(const Step<T>& step) {
    if (invocation_ < step.first_invocation || invocation_ >= step.first_invocation + kLanes) return;
    const std::size_t lane = invocation_ - step.first_invocation;
    if ((step.lanes >> lane & 1U) == 0) return;
    const OperationInfo& info = step.info();
    TraceStep traced{step.place(), std::string(step.name()), value_of(step, info.result, lane), {}};
    if (traced.operation == "Store") {
        // Through an address the variable's own slots are not what was written.
        traced.result.components = value_of(step, info.operands.front(), lane).components;
    } else if (traced.operation == "Load") {
        traced.result.name = step.program.names[info.operands.front().name];
    } else {
        for (const Slice& operand : info.operands) traced.operands.push_back(value_of(step, operand, lane));
        if (traced.operation == "AccessChain") traced.result.components.clear();
    }
    steps_.push_back(std::move(traced));
}

template <class T>
void Trace<T>::clamped(const Step<T>& step, std::size_t lane, std::int64_t index, std::uint32_t extent) {
    if (step.first_invocation + lane != invocation_) return;
    steps_.push_back({step.place(),
                      fmt::format("index {} is outside [0, {}) and is clamped", index, extent),
                      {step.program.names[step.info().result.name], {}},
                      {}});
}

template class Trace<float>;
template class Trace<double>;

std::string to_text(const std::vector<double>& components) {
    std::vector<std::string> numbers;
    for (const double component : components) {
        const auto rounded = static_cast<float>(component);
        const bool is_float = static_cast<double>(rounded) == component;
        numbers.push_back(is_float ? fmt::format("{}", rounded) : fmt::format("{}", component));
    }
    if (numbers.size() == 1) return numbers.front();
    return fmt::format("({})", fmt::join(numbers, ", "));
}

namespace {

std::string to_text(const TracedValue& value) {
    if (value.components.empty()) return value.name;
    const std::string numbers = evaluate::to_text(value.components);
    return value.name.empty() ? numbers : fmt::format("{}={}", value.name, numbers);
}

}  // namespace

std::string to_text(const std::vector<TraceStep>& steps) {
    std::string text;
    Place place;
    for (const TraceStep& step : steps) {
        if (text.empty() || step.place != place) {
            place = step.place;
            text += place.file.empty() ? std::string("(no line)\n")
                                       : fmt::format("{}:{}\n", place.file, place.line);
        }
        std::vector<std::string> operands;
        for (const TracedValue& operand : step.operands) operands.push_back(to_text(operand));
        text += fmt::format("    {}", step.operation);
        if (!operands.empty()) text += fmt::format(" {}", fmt::join(operands, ", "));
        const std::string result = to_text(step.result);
        if (!result.empty()) text += fmt::format(" -> {}", result);
        text += "\n";
    }
    return text;
}

}  // namespace gobo::evaluate
