#include "lab/sanitize/output_findings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::kLanes;

/// Which way an output left its bounds; nothing where it did not.
std::string_view fault_of(double value, const Interval& bounds) {
    if (std::isnan(value)) return "is not a number";
    if (value < bounds.low && bounds.low == kLeastAboveZero) return "is not above 0";
    if (value < bounds.low) return bounds.low == 0 ? "is negative" : "is below what its inputs allow";
    if (value > bounds.high) return std::isinf(value) ? "is infinite" : "is above what its inputs allow";
    return {};
}

/// What a value outside of its bounds breaks, as GLSL spells it; nothing where it is no promise.
std::string_view broken_promise(double value, const Interval& bounds) {
    switch (bounds.promise) {
        case DepthPromise::greater:
            return value < bounds.low ? "depth_greater" : "";
        case DepthPromise::less:
            return value > bounds.high ? "depth_less" : "";
        case DepthPromise::unchanged:
            return "depth_unchanged";
        default:
            return "";
    }
}

/// Findings about outputs, each at the first invocation that showed it.
struct OutputFindings {
    const Run& run;
    std::map<std::string, Finding> by_message = {};

    Finding& add(const evaluate::Port& port, std::string_view fault, std::size_t index,
                 std::string text = {}) {
        const std::string message = fmt::format("the output '{}' {}", port.name, fault);
        Finding& finding = by_message[message];
        if (finding.points++ == 0)
            run.show(finding, message, std::move(text), index, last_store(run.program, port));
        return finding;
    }
};

/// Outputs that some invocation, not discarded, leaves unwritten.
void add_unwritten(const evaluate::Outputs& outputs, const Observed& observed, OutputFindings& findings) {
    for (const UndefinedOutput& unwritten : observed.undefined) {
        const evaluate::Port& port = findings.run.program.outputs[unwritten.output];
        if (!unwritten.is_unwritten || !must_be_written(findings.run.program, port)) continue;
        const bool is_stored = last_store(findings.run.program, port).has_value();
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t index = unwritten.first_invocation + lane;
            if ((unwritten.lanes >> lane & 1U) != 0 && index < outputs.count && !outputs.discarded[index])
                findings.add(port, is_stored ? "is not written on some path" : "is never written", index)
                    .machine = Machine::ieee;
        }
    }
}

/// Per invocation whether it leaves that output unwritten.
std::vector<char> unwritten_in(const Observed& observed, std::size_t output, std::size_t count) {
    std::vector<char> unwritten(count);
    for (const UndefinedOutput& undefined : observed.undefined)
        for (std::size_t lane = 0; lane < kLanes && undefined.output == output; ++lane)
            if (undefined.is_unwritten && (undefined.lanes >> lane & 1U) != 0 &&
                undefined.first_invocation + lane < count)
                unwritten[undefined.first_invocation + lane] = 1;
    return unwritten;
}

/// What 16-bit floats may pass a bound by: some thirty roundings.
constexpr double kRoundingsOfHalf = 1 + 32 * 0x1p-11;

/// What the machine may give where exact numbers are within the bounds.
Interval with_roundings(Interval bounds, Machine machine) {
    if (!options_of(machine).is_half || bounds.promise != DepthPromise::none) return bounds;
    if (bounds.low < 0) bounds.low = std::max(bounds.low * kRoundingsOfHalf, Interval{}.low);
    bounds.high = std::min(bounds.high * kRoundingsOfHalf, Interval{}.high);
    return bounds;
}

/// Outputs beyond their bounds at points that write them, and neither trap nor are discarded.
void add_out_of_bounds(const evaluate::Outputs& outputs, const Observed& observed,
                       std::span<const Interval> all, OutputFindings& findings) {
    const std::size_t components = all.size() / outputs.count;
    std::size_t component = 0;
    for (std::size_t output = 0; output < findings.run.program.outputs.size(); ++output) {
        const evaluate::Port& port = findings.run.program.outputs[output];
        const std::vector<char> unwritten = unwritten_in(observed, output, outputs.count);
        const std::vector<double>& values = outputs.values.at(port.name);
        // Every vertex stage has one: it matters where it is written.
        const bool is_left_out =
            port.name == "gl_PointSize" && !last_store(findings.run.program, port).has_value();
        for (std::uint32_t c = 0; c < port.components; ++c, ++component)
            for (std::size_t i = 0; i < outputs.count; ++i) {
                const double value = values[c * outputs.count + i];
                const Interval bounds = with_roundings(all[i * components + component], findings.run.machine);
                if (value >= bounds.low && value <= bounds.high) continue;
                if (is_left_out || unwritten[i] != 0 || outputs.discarded[i] || observed.is_trapped(i))
                    continue;
                const auto low = static_cast<float>(bounds.low);
                const auto high = static_cast<float>(bounds.high);
                const std::string_view promise = broken_promise(value, bounds);
                Finding& finding =
                    promise.empty()
                        ? findings.add(
                              port, fault_of(value, bounds), i,
                              fmt::format("{} is not within [{}, {}]", static_cast<float>(value), low, high))
                        : findings.add(port, fmt::format("breaks {}", promise), i,
                                       fmt::format("{} where gl_FragCoord.z is {}", static_cast<float>(value),
                                                   value < bounds.low ? low : high));
                finding.follows_from_constants = observed.is_of_constants(i);
            }
    }
}

}  // namespace

std::optional<std::uint32_t> last_store(const evaluate::Program& program, const evaluate::Port& port) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Slice& to = program.infos[at].result;
        const std::uint32_t code = evaluate::row_of(program.operations[at]).code;
        const bool is_within = to.slot < port.slot + port.components && port.slot < to.slot + to.count;
        const bool may_be_within = code == evaluate::kScatter && port.is_written && to.slot <= port.slot;
        if ((code == spv::OpStore && is_within) || may_be_within) found = at;
    }
    return found;
}

bool must_be_written(const evaluate::Program& program, const evaluate::Port& port) {
    if (port.is_written || last_store(program, port)) return true;
    return program.is_fragment && !port.name.starts_with("gl_");
}

std::vector<const evaluate::Port*> written_ports(const evaluate::Program& program) {
    std::vector<const evaluate::Port*> ports;
    for (const evaluate::Port& port : program.outputs) ports.push_back(&port);
    for (const evaluate::Port& port : program.uniforms)
        if (port.is_written) ports.push_back(&port);
    return ports;
}

std::vector<Finding> output_findings(const Run& run, const evaluate::Outputs& outputs,
                                     const Observed& observed, std::span<const Interval> bounds) {
    OutputFindings found{run};
    add_unwritten(outputs, observed, found);
    if (!bounds.empty()) add_out_of_bounds(outputs, observed, bounds, found);
    std::vector<Finding> findings;
    for (auto& [message, finding] : found.by_message) findings.push_back(std::move(finding));
    return findings;
}

}  // namespace gobo::sanitize
