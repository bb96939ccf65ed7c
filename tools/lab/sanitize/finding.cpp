#include "lab/sanitize/finding.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

/// The operation that last stores to the output; nothing where none does.
std::optional<std::uint32_t> last_store(const evaluate::Program& program, const evaluate::Port& port) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t at = 0; at < program.operations.size(); ++at) {
        const std::uint32_t code = evaluate::instruction_table()[program.operations[at].row].code;
        const evaluate::Slice& to = program.infos[at].result;
        const bool is_within = to.slot < port.slot + port.components && port.slot < to.slot + to.count;
        if (code == spv::OpStore && is_within) found = at;
    }
    return found;
}

/// Outputs of OpenGL's own may be left alone, and vertex outputs that the fragment stage does not read.
bool must_be_written(const evaluate::Program& program, const evaluate::Port& port) {
    if (last_store(program, port)) return true;
    return program.is_fragment && !port.name.starts_with("gl_");
}

/// Which way an output left its bounds; nothing where it did not.
std::string_view fault_of(double value, const Interval& bounds) {
    if (std::isnan(value)) return "is not a number";
    if (value < bounds.low) return bounds.low == 0 ? "is negative" : "is below what its inputs allow";
    if (value > bounds.high) return std::isinf(value) ? "is infinite" : "is above what its inputs allow";
    return {};
}

/// Findings about outputs, each at the first invocation that showed it.
struct OutputFindings {
    const evaluate::Program& program;
    const evaluate::Invocations& invocations;
    std::map<std::string, Finding> by_message = {};

    void add(const evaluate::Port& port, std::string_view fault, std::size_t index, Machine machine,
             const std::string& operation = {}) {
        const std::string message = fmt::format("the output '{}' {}", port.name, fault);
        Finding& finding = by_message[message];
        if (finding.points++ > 0) return;
        finding.message = message;
        finding.operation = operation;
        finding.machine = machine;
        if (const auto store = last_store(program, port)) finding.place = program.place_of(*store);
        finding.point = point_of(program, invocations, index);
    }
};

/// Outputs that some invocation, not discarded, leaves unwritten.
void add_unwritten(const evaluate::Outputs& outputs, const TrapObserver& observer, OutputFindings& findings) {
    for (const Unwritten& unwritten : observer.unwritten()) {
        const evaluate::Port& port = findings.program.outputs[unwritten.output];
        if (!must_be_written(findings.program, port)) continue;
        for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
            const std::size_t index = unwritten.first_invocation + lane;
            if ((unwritten.lanes >> lane & 1U) != 0 && index < outputs.count && !outputs.discarded[index])
                findings.add(port, "is not written on some path", index, Machine::ieee);
        }
    }
}

/// Outputs beyond their bounds at points that neither trap nor are discarded.
void add_out_of_bounds(const evaluate::Outputs& outputs, const TrapObserver& observer, Machine machine,
                       std::span<const Interval> all, OutputFindings& findings) {
    const std::size_t components = all.size() / outputs.count;
    std::size_t component = 0;
    for (const evaluate::Port& port : findings.program.outputs) {
        const std::vector<double>& values = outputs.values.at(port.name);
        for (std::uint32_t c = 0; c < port.components; ++c, ++component)
            for (std::size_t i = 0; i < outputs.count; ++i) {
                const double value = values[c * outputs.count + i];
                const Interval& bounds = all[i * components + component];
                if (value >= bounds.low && value <= bounds.high) continue;
                if (outputs.discarded[i] || observer.trapped(i)) continue;
                findings.add(port, fault_of(value, bounds), i, machine,
                             fmt::format("{} is not within [{}, {}]", static_cast<float>(value),
                                         static_cast<float>(bounds.low), static_cast<float>(bounds.high)));
            }
    }
}

}  // namespace

Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                        const evaluate::Invocations& invocations, Machine machine,
                                        std::span<const Interval> bounds, ReachObserver* reach) {
    TrapObserver observer(program, reach);
    GOBO_TRY(const auto outputs, evaluate::run<float>(program, invocations, options_of(machine), &observer));
    observer.finish();
    OutputFindings of_outputs{program, invocations};
    add_unwritten(outputs, observer, of_outputs);
    if (!bounds.empty()) add_out_of_bounds(outputs, observer, machine, bounds, of_outputs);
    std::vector<Finding> findings;
    for (auto& [message, finding] : of_outputs.by_message) findings.push_back(std::move(finding));
    for (const auto& [where, hit] : observer.hits()) {
        Finding& finding = findings.emplace_back();
        finding.place = program.place_of(where.first);
        finding.message = where.second;
        finding.operation = hit.operation;
        finding.machine = machine;
        finding.point = point_of(program, invocations, hit.first);
        finding.points = hit.invocations;
    }
    return findings;
}

std::string to_text(const Finding& finding) {
    std::string text = finding.message;
    if (!finding.operation.empty()) text += ": " + finding.operation;
    if (finding.machine != Machine::ieee) text += fmt::format(", machine {}", name_of(finding.machine));
    return text;
}

std::string eval_input(const Finding& finding, const std::string& heading) {
    const std::string comment =
        fmt::format("# {}\n# {}:{}: {}\n", heading, finding.place.file, finding.place.line, to_text(finding));
    return evaluate::eval_file(gobo::name_of(finding.stage), finding.point, comment,
                               evaluate::Digits::of_float);
}

}  // namespace gobo::sanitize
