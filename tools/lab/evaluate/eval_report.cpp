#include "lab/evaluate/eval_report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace gobo::evaluate {
namespace {

/// The difference of a component; NaN where one arithmetic gives a number and the other none.
double difference(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    return std::fabs(a - b);
}

std::vector<double> differences(const EvalOutput& output) {
    std::vector<double> all;
    for (std::size_t i = 0; i < output.in_float.size(); ++i)
        all.push_back(difference(output.in_float[i], output.in_double[i]));
    return all;
}

/// Numbers in columns of their own.
std::string columns(const char* label, const std::vector<double>& numbers, const char* format) {
    std::string line = fmt::format("  {:<12}", label);
    for (const double number : numbers)
        line += fmt::format("{:<25}", fmt::format(fmt::runtime(format), number));
    return std::string(line.substr(0, line.find_last_not_of(' ') + 1)) + "\n";
}

std::string outputs_text(const EvalReport& report) {
    std::string text;
    for (const EvalOutput& output : report.outputs) {
        text += fmt::format("{} ({})\n", output.name, output.type);
        // Nine digits tell every fp32 number from its neighbours, seventeen every fp64 number.
        text += columns("fp32", output.in_float, "{:.9g}");
        text += columns("fp64", output.in_double, "{:.17g}");
        text += columns("difference", differences(output), "{:.2g}");
    }
    if (report.is_discarded_in_float && report.is_discarded_in_double)
        text += "discarded\n";
    else if (report.is_discarded_in_float)
        text += "discarded in fp32 only\n";
    else if (report.is_discarded_in_double)
        text += "discarded in fp64 only\n";
    return text;
}

std::string counts_text(const Counts& counts) {
    std::vector<std::string> parts;
    for (std::size_t kind = 0; kind < kKinds; ++kind)
        if (counts[kind] != 0) parts.push_back(fmt::format("{} {}", kKindNames[kind], counts[kind]));
    return fmt::format("operations: {}\n", join(parts, ", "));
}

std::string trace_text(const std::vector<TraceStep>& steps, const SourceLine& source_line) {
    std::string text;
    std::vector<TraceStep> same_place;
    const auto flush = [&] {
        if (same_place.empty()) return;
        std::string lines = to_text(same_place);
        const std::string source(trim(source_line(same_place.front().place)));
        if (!source.empty()) lines.insert(lines.find('\n'), ": " + source);
        text += lines;
        same_place.clear();
    };
    for (const TraceStep& step : steps) {
        if (!same_place.empty() && same_place.front().place != step.place) flush();
        same_place.push_back(step);
    }
    flush();
    return text;
}

nlohmann::ordered_json numbers_json(const std::vector<double>& numbers) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const double number : numbers) {
        if (std::isfinite(number))
            list.push_back(number);
        else
            list.push_back(std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf");
    }
    return list;
}

nlohmann::ordered_json value_json(const TracedValue& value) {
    nlohmann::ordered_json json;
    if (!value.name.empty()) json["name"] = value.name;
    json["value"] = numbers_json(value.components);
    return json;
}

nlohmann::ordered_json trace_json(const std::vector<TraceStep>& steps) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TraceStep& step : steps) {
        nlohmann::ordered_json operands = nlohmann::ordered_json::array();
        for (const TracedValue& operand : step.operands) operands.push_back(value_json(operand));
        list.push_back({{"file", step.place.file},
                        {"line", step.place.line},
                        {"operation", step.operation},
                        {"operands", std::move(operands)},
                        {"result", value_json(step.result)}});
    }
    return list;
}

}  // namespace

Result<EvalReport> evaluate_once(const Program& program, const Invocations& invocations, bool with_trace) {
    Options options;
    options.count = true;
    Trace<float> trace;
    Result<Outputs> in_float = run<float>(program, invocations, options, with_trace ? &trace : nullptr);
    if (!in_float) return tl::unexpected(in_float.error());
    Result<Outputs> in_double = run<double>(program, invocations);
    if (!in_double) return tl::unexpected(in_double.error());
    EvalReport report;
    for (const Port& port : program.outputs)
        report.outputs.push_back(
            {port.name, port.type, in_float->values[port.name], in_double->values[port.name]});
    report.is_discarded_in_float = in_float->discarded.front();
    report.is_discarded_in_double = in_double->discarded.front();
    report.counts = in_float->counts.front();
    report.trace = trace.steps();
    return report;
}

std::string to_text(const EvalReport& report, const SourceLine& source_line) {
    std::string text = trace_text(report.trace, source_line);
    if (!text.empty()) text += "\n";
    return text + outputs_text(report) + counts_text(report.counts);
}

nlohmann::ordered_json to_json(const EvalReport& report) {
    nlohmann::ordered_json json;
    json["outputs"] = nlohmann::ordered_json::array();
    for (const EvalOutput& output : report.outputs)
        json["outputs"].push_back({{"name", output.name},
                                   {"type", output.type},
                                   {"fp32", numbers_json(output.in_float)},
                                   {"fp64", numbers_json(output.in_double)},
                                   {"difference", numbers_json(differences(output))}});
    json["discarded"] = {{"fp32", report.is_discarded_in_float}, {"fp64", report.is_discarded_in_double}};
    json["counts"] = nlohmann::ordered_json::object();
    for (std::size_t kind = 0; kind < kKinds; ++kind)
        if (report.counts[kind] != 0) json["counts"][std::string(kKindNames[kind])] = report.counts[kind];
    if (!report.trace.empty()) json["trace"] = trace_json(report.trace);
    return json;
}

}  // namespace gobo::evaluate
