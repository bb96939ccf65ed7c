#include "lab/sanitize/find_traps.hpp"

#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/trap_observer.hpp"

namespace gobo::sanitize {
namespace {

/// The operation that last stores to the output; nothing where none does.
std::optional<std::uint32_t> last_store(const evaluate::Program& program, const evaluate::Port& port) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        const evaluate::Slice& to = program.infos[at].result;
        const bool is_within = to.slot < port.slot + port.components && port.slot < to.slot + to.count;
        if (row.kind == evaluate::Kind::store && is_within) found = at;
    }
    return found;
}

/// Outputs of OpenGL's own may be left alone, and vertex outputs that the fragment stage does not read.
bool must_be_written(const evaluate::Program& program, const evaluate::Port& port) {
    if (last_store(program, port)) return true;
    return program.is_fragment && !port.name.starts_with("gl_");
}

/// One finding for each output that some invocation, not discarded, leaves unwritten.
std::vector<Finding> unwritten_outputs(const evaluate::Program& program,
                                       const evaluate::Invocations& invocations,
                                       const evaluate::Outputs& outputs, const TrapObserver& observer) {
    std::map<std::size_t, Finding> findings;
    for (const Unwritten& unwritten : observer.unwritten()) {
        const evaluate::Port& port = program.outputs[unwritten.output];
        if (!must_be_written(program, port)) continue;
        for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
            const std::size_t index = unwritten.first_invocation + lane;
            if ((unwritten.lanes >> lane & 1U) == 0 || index >= invocations.count || outputs.discarded[index])
                continue;
            Finding& finding = findings[unwritten.output];
            if (finding.points++ > 0) continue;
            finding.message = fmt::format("the output '{}' is not written on some path", port.name);
            if (const auto store = last_store(program, port)) finding.place = program.place_of(*store);
            finding.point = point_of(program, invocations, index);
        }
    }
    std::vector<Finding> result;
    for (auto& [output, finding] : findings) result.push_back(std::move(finding));
    return result;
}

/// Lets another observer see what the traps' sees.
class BothObservers final : public evaluate::Observer<float> {
  public:
    BothObservers(TrapObserver& traps, evaluate::Observer<float>* other) : traps_(traps), other_(other) {}
    void after(const evaluate::Step<float>& step) override {
        traps_.after(step);
        other_->after(step);
    }
    void clamped(const evaluate::Step<float>& step, std::size_t lane, std::int64_t index,
                 std::uint32_t extent) override {
        traps_.clamped(step, lane, index, extent);
    }

  private:
    TrapObserver& traps_;
    evaluate::Observer<float>* other_;
};

/// Which way an output left its bounds; nothing where it did not.
std::string_view fault_of(double value, const Interval& bounds) {
    if (std::isnan(value)) return "is no number";
    if (value < bounds.low) return bounds.low == 0 ? "is negative" : "is below what its inputs allow";
    if (value > bounds.high) return std::isinf(value) ? "is infinite" : "is above what its inputs allow";
    return {};
}

/// Finds outputs beyond their bounds at points that neither trap nor are discarded.
class BoundsCheck {
  public:
    BoundsCheck(const evaluate::Program& program, const evaluate::Invocations& invocations,
                const evaluate::Outputs& outputs, const TrapObserver& observer,
                std::span<const Interval> bounds)
        : program_(program),
          invocations_(invocations),
          outputs_(outputs),
          observer_(observer),
          bounds_(bounds),
          components_(bounds.size() / invocations.count) {}

    std::vector<Finding> run() {
        std::size_t component = 0;
        for (const evaluate::Port& port : program_.outputs) {
            const std::vector<double>& values = outputs_.values.at(port.name);
            for (std::uint32_t c = 0; c < port.components; ++c, ++component)
                for (std::size_t i = 0; i < outputs_.count; ++i)
                    judge(port, values[c * outputs_.count + i], component, i);
        }
        std::vector<Finding> result;
        for (auto& [message, finding] : findings_) result.push_back(std::move(finding));
        return result;
    }

  private:
    void judge(const evaluate::Port& port, double value, std::size_t component, std::size_t index) {
        const Interval& bounds = bounds_[index * components_ + component];
        if (value >= bounds.low && value <= bounds.high) return;
        if (outputs_.discarded[index] || observer_.trapped(index)) return;
        Finding& finding = findings_[fmt::format("the output '{}' {}", port.name, fault_of(value, bounds))];
        if (finding.points++ > 0) return;
        finding.message = fmt::format("the output '{}' {}", port.name, fault_of(value, bounds));
        finding.operation = fmt::format("{} is not within [{}, {}]", static_cast<float>(value),
                                        static_cast<float>(bounds.low), static_cast<float>(bounds.high));
        if (const auto store = last_store(program_, port)) finding.place = program_.place_of(*store);
        finding.point = point_of(program_, invocations_, index);
    }

    const evaluate::Program& program_;
    const evaluate::Invocations& invocations_;
    const evaluate::Outputs& outputs_;
    const TrapObserver& observer_;
    std::span<const Interval> bounds_;
    std::size_t components_;  ///< of all outputs together
    std::map<std::string, Finding> findings_;
};

}  // namespace

Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                        const evaluate::Invocations& invocations, Machine machine,
                                        std::span<const Interval> bounds, evaluate::Observer<float>* also) {
    TrapObserver observer(program);
    BothObservers both(observer, also);
    evaluate::Observer<float>* watching = &observer;
    if (also != nullptr) watching = &both;
    const Result<evaluate::Outputs> outputs =
        evaluate::run<float>(program, invocations, options_of(machine), watching);
    if (!outputs) return tl::unexpected(outputs.error());
    observer.finish();
    std::vector<Finding> findings = unwritten_outputs(program, invocations, *outputs, observer);
    if (!bounds.empty()) {
        for (Finding& finding : BoundsCheck(program, invocations, *outputs, observer, bounds).run()) {
            finding.machine = machine;
            findings.push_back(std::move(finding));
        }
    }
    for (const auto& [where, hit] : observer.hits()) {
        Finding finding;
        finding.place = program.place_of(where.first);
        finding.message = where.second;
        finding.operation = hit.operation;
        finding.machine = machine;
        finding.point = point_of(program, invocations, hit.first);
        finding.points = hit.invocations;
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace gobo::sanitize
