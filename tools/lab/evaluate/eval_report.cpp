#include "lab/evaluate/eval_report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/instruction_table.hpp"

namespace gobo::evaluate {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
TracedValue value_of(const Step<T>& step, const Slice& slice, std::size_t lane) {
    TracedValue value{step.program.names[slice.name], {}};
    for (std::uint32_t component = 0; component < slice.count; ++component)
        value.components.push_back(step.value(slice, component, lane));
    return value;
}

std::string value_text(const TracedValue& value) {
    if (value.components.empty()) return value.name;
    const std::string numbers = to_text(value.components);
    return value.name.empty() ? numbers : fmt::format("{}={}", value.name, numbers);
}

/// Of each component; NaN where one arithmetic gives a number and the other none.
std::vector<double> differences(const EvalOutput& output) {
    std::vector<double> all;
    for (std::size_t i = 0; i < output.in_float.size(); ++i) {
        const double a = output.in_float[i];
        const double b = output.in_double[i];
        all.push_back(a == b || (std::isnan(a) && std::isnan(b)) ? 0 : std::fabs(a - b));
    }
    return all;
}

/// Numbers in columns of their own.
std::string columns(const char* label, const std::vector<double>& numbers, const char* format) {
    std::string line = fmt::format("  {:<12}", label);
    for (const double number : numbers)
        line += fmt::format("{:<25}",
                            fmt::format(fmt::runtime(format), std::isnan(number) ? std::nan("") : number));
    return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string outputs_text(const EvalReport& report) {
    std::string text;
    for (const EvalOutput& output : report.outputs) {
        text += fmt::format("{} ({}){}\n", output.name, output.type, output.is_written ? ", written" : "");
        // Nine digits tell every fp32 number from its neighbours, seventeen every fp64 number.
        text += columns("fp32", output.in_float, output.is_wide ? "{:.17g}" : "{:.9g}");
        text += columns("fp64", output.in_double, "{:.17g}");
        text += columns("difference", differences(output), "{:.2g}");
    }
    const bool in_float = report.is_discarded_in_float;
    if (in_float && report.is_discarded_in_double) return text + "discarded\n";
    if (in_float || report.is_discarded_in_double)
        text += fmt::format("discarded in {} only\n", in_float ? "fp32" : "fp64");
    return text;
}

Json numbers_json(const std::vector<double>& numbers) {
    Json list = Json::array();
    for (const double number : numbers) {
        if (std::isfinite(number))
            list.push_back(number);
        else
            list.push_back(std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf");
    }
    return list;
}

Json value_json(const TracedValue& value) {
    Json json;
    if (!value.name.empty()) json["name"] = value.name;
    json["value"] = numbers_json(value.components);
    return json;
}

Json trace_json(const std::vector<TraceStep>& steps) {
    Json list = Json::array();
    for (const TraceStep& step : steps) {
        Json operands = Json::array();
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

template <class T>
void Trace<T>::after(const Step<T>& step) {
    if (invocation_ < step.first_invocation || invocation_ >= step.first_invocation + kLanes) return;
    const std::size_t lane = invocation_ - step.first_invocation;
    if ((step.lanes >> lane & 1U) == 0) return;
    const OperationInfo& info = step.info();
    const Row& row = step.row();
    TraceStep traced{step.place(), std::string(row.name), value_of(step, info.result, lane), {}};
    if (row.kind == Kind::store) {
        // Through an address the variable's own slots are not what was written.
        if (row.code == kScatter)
            traced.result.components = value_of(step, info.operands.front(), lane).components;
    } else if (row.kind == Kind::load) {
        traced.result.name = step.program.names[info.operands.front().name];
    } else {
        for (const Slice& operand : info.operands) traced.operands.push_back(value_of(step, operand, lane));
        if (row.code == spv::OpAccessChain) traced.result.components.clear();
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
    for (const double component : components)  // the sign of a NaN means nothing, and differs by machine
        numbers.push_back(std::isnan(component) ? "nan" : number_text(component, Digits::of_float));
    if (numbers.size() == 1) return numbers.front();
    return fmt::format("({})", fmt::join(numbers, ", "));
}

std::string to_text(const std::vector<TraceStep>& steps, const SourceLine& source_line) {
    std::string text;
    const Place* place = nullptr;
    for (const TraceStep& step : steps) {
        if (place == nullptr || step.place != *place) {
            place = &step.place;
            const std::string source(trim(source_line(step.place)));
            text += place->file.empty() ? std::string("(no line)")
                                        : fmt::format("{}:{}", place->file, place->line);
            text += source.empty() ? "\n" : ": " + source + "\n";
        }
        std::vector<std::string> operands;
        for (const TracedValue& operand : step.operands) operands.push_back(value_text(operand));
        text += fmt::format("    {}", step.operation);
        if (!operands.empty()) text += fmt::format(" {}", fmt::join(operands, ", "));
        const std::string result = value_text(step.result);
        text += result.empty() ? "\n" : " -> " + result + "\n";
    }
    return text;
}

namespace {

/// What one invocation gives.
std::vector<double> numbers_of(const Outputs& outputs, const Port& port, std::size_t invocation) {
    const std::vector<double>& all = outputs.values.at(port.name);
    std::vector<double> numbers;
    for (std::size_t component = 0; component < port.components; ++component)
        numbers.push_back(all[component * outputs.count + invocation]);
    return numbers;
}

/// What the invocation left in storage blocks and counters that was not there before.
void add_written_ports(const Program& program, const Invocations& invocations, const Outputs& in_float,
                       const Outputs& in_double, std::size_t at, EvalReport& report) {
    for (const Port& port : program.uniforms) {
        if (!port.is_written) continue;
        const auto given = invocations.values.find(port.name);
        const std::vector<double> before =
            given == invocations.values.end() ? std::vector<double>(port.components) : given->second;
        EvalOutput output{
            port.name, port.type,           numbers_of(in_float, port, at), numbers_of(in_double, port, at),
            true,      is_wide(port.scalar)};
        if (output.in_float != before || output.in_double != before)
            report.outputs.push_back(std::move(output));
    }
}

/// "counts[3, 4]": the texel as the shader names it.
std::string texel_name(const Program& program, const TexelPlace& place) {
    const ImagePort& image = program.images[place.image];
    const std::size_t count = dimensions_of(image.type) + (image.type.arrayed ? 1 : 0);
    std::string name =
        fmt::format("{}[{}", image.name, fmt::join(std::span(place.coordinates).first(count), ", "));
    return name + (image.type.multisampled ? fmt::format(", sample {}]", place.sample) : "]");
}

/// What it left in texels; a NaN where one arithmetic did not write.
void add_written_texels(const Program& program, const Outputs& in_float, const Outputs& in_double,
                        std::size_t at, EvalReport& report) {
    std::map<std::string, EvalOutput> texels;
    for (const Outputs* const outputs : {&in_float, &in_double})
        for (const WrittenTexel& written : outputs->written) {
            if (written.place.invocation != at || written.place.image >= program.images.size()) continue;
            const std::string name = texel_name(program, written.place);
            const Scalar scalar = program.images[written.place.image].scalar;
            EvalOutput& texel = texels[name];
            texel.name = name;
            texel.type = GlslType{scalar, 1, 4}.name();
            texel.is_written = true;
            for (auto* const numbers : {&texel.in_float, &texel.in_double}) numbers->resize(4, std::nan(""));
            (outputs == &in_float ? texel.in_float : texel.in_double)
                .assign(written.texel.begin(), written.texel.end());
        }
    for (auto& [name, texel] : texels) report.outputs.push_back(std::move(texel));
}

template <class T>
Result<Outputs> traced(const Program& program, const Invocations& invocations, const Options& arithmetic,
                       const EvalOptions& options, std::vector<TraceStep>& steps) {
    Trace<T> trace(options.invocation);
    GOBO_TRY(Outputs outputs,
             run<T>(program, invocations, arithmetic, options.with_trace ? &trace : nullptr));
    steps = trace.steps();
    return outputs;
}

}  // namespace

Result<EvalReport> evaluate_once(const Program& program, const Invocations& invocations,
                                 const EvalOptions& options) {
    std::vector<TraceStep> trace;
    Options in_floats = options.arithmetic;
    in_floats.count = true;
    in_floats.is_single = program.has_wide;
    in_floats.iteration_limit = kMostIterations;  // as the sanitizer, whose inputs are replayed here
    GOBO_TRY(const Outputs in_float, program.has_wide
                                         ? traced<double>(program, invocations, in_floats, options, trace)
                                         : traced<float>(program, invocations, in_floats, options, trace));
    GOBO_TRY(const Outputs in_double, run<double>(program, invocations));
    EvalReport report;
    const std::size_t at = std::min(options.invocation, invocations.count - 1);
    for (const Port& port : program.outputs)
        report.outputs.push_back({port.name, port.type, numbers_of(in_float, port, at),
                                  numbers_of(in_double, port, at), false, is_wide(port.scalar)});
    add_written_ports(program, invocations, in_float, in_double, at, report);
    add_written_texels(program, in_float, in_double, at, report);
    report.is_discarded_in_float = in_float.discarded[at];
    report.is_discarded_in_double = in_double.discarded[at];
    report.counts = in_float.counts[at];
    report.trace = std::move(trace);
    return report;
}

std::string to_text(const EvalReport& report, const SourceLine& source_line) {
    std::string text = to_text(report.trace, source_line);
    if (!text.empty()) text += "\n";
    std::vector<std::string> counts;
    for (std::size_t kind = 0; kind < kKinds; ++kind)
        if (report.counts[kind] != 0)
            counts.push_back(fmt::format("{} {}", kKindNames[kind], report.counts[kind]));
    return text + outputs_text(report) + fmt::format("operations: {}\n", join(counts, ", "));
}

Json to_json(const EvalReport& report) {
    Json json;
    json["outputs"] = Json::array();
    for (const EvalOutput& output : report.outputs)
        json[output.is_written ? "written" : "outputs"].push_back(
            {{"name", output.name},
             {"type", output.type},
             {"fp32", numbers_json(output.in_float)},
             {"fp64", numbers_json(output.in_double)},
             {"difference", numbers_json(differences(output))}});
    json["discarded"] = {{"fp32", report.is_discarded_in_float}, {"fp64", report.is_discarded_in_double}};
    json["counts"] = Json::object();
    for (std::size_t kind = 0; kind < kKinds; ++kind)
        if (report.counts[kind] != 0) json["counts"][std::string(kKindNames[kind])] = report.counts[kind];
    if (!report.trace.empty()) json["trace"] = trace_json(report.trace);
    return json;
}

}  // namespace gobo::evaluate
