#include "lab/sanitize/finding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/ranges.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/rules.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using evaluate::Operation;
using evaluate::Slice;
using Step = evaluate::Step<float>;

constexpr Lanes kAll = ~Lanes{0};

std::uint32_t code_of(const Operation& operation) {
    return evaluate::instruction_table()[operation.row].code;
}

/// The slot that a lane's dynamic address leads to.
std::uint32_t address(const Step& step, std::uint32_t base, std::uint32_t offset_slot, std::size_t lane) {
    evaluate::Slice offset;
    offset.slot = offset_slot;
    return base + static_cast<std::uint32_t>(int_row(step, offset, 0)[lane]);
}

/// Which values hold something that was never written, lane by lane. Follows unwritten values through loads,
/// stores and the parts of composites. Copying one is fine, as a vector that is filled component by component
/// is copied half empty; computing with one is not.
class Definedness {
  public:
    explicit Definedness(const evaluate::Program& program)
        : program_(program), undefined_(program.slots), followers_(program.operations.size()) {
        for (const evaluate::Block& block : program.blocks) {
            std::uint32_t copies = 0;
            for (std::uint32_t at = block.first + block.count; at-- > block.first;) {
                followers_[at] = copies;
                copies = code_of(program.operations[at]) == evaluate::kCopy ? copies + 1 : 0;
            }
        }
    }

    /// Nothing is written yet.
    void begin() {
        std::fill(undefined_.begin(), undefined_.end(), 0);
        for (const auto& [slot, count] : program_.variables)
            std::fill_n(undefined_.begin() + slot, count, kAll);
    }

    /// The lanes in which some component of the slots is unwritten.
    [[nodiscard]] Lanes undefined_in(std::uint32_t slot, std::uint32_t count) const {
        Lanes lanes = 0;
        for (std::uint32_t at = slot; at < slot + count; ++at) lanes |= undefined_[at];
        return lanes;
    }

    /// To be called after each step. The lanes in which it computed with a value that was never written.
    [[nodiscard]] Lanes after(const Step& step) {
        const Lanes hits = move(step, program_.operations[step.operation]);
        for (std::uint32_t next = 1; next <= followers_[step.operation]; ++next) {
            const Operation& keep = program_.operations[step.operation + next];
            copy(keep.result, keep.operands[0], keep.count, step.lanes);
        }
        return hits;
    }

  private:
    Lanes move(const Step& step, const Operation& operation) {
        const std::uint32_t* words = program_.words.data() + operation.extra;
        const auto& operands = operation.operands;
        scratch_.clear();
        switch (code_of(operation)) {
            case spv::OpStore:
                copy(operation.result, operands[0], operation.count, step.lanes);
                return 0;
            case spv::OpLoad:
            case spv::OpCopyObject:
            case spv::OpCompositeExtract:
                copy(operation.result, operands[0], operation.count, kAll);
                return 0;
            case evaluate::kGather:
                gather(step, operation);
                return 0;
            case evaluate::kScatter:
                for (std::size_t lane = 0; lane < kLanes; ++lane)
                    if ((step.lanes >> lane & 1U) != 0)
                        copy(address(step, operation.result, operands[1], lane), operands[0], operation.count,
                             Lanes{1} << lane);
                return 0;
            case spv::OpCompositeConstruct:
                for (const std::uint32_t* part = words; part < words + operation.extras; part += 2)
                    scratch_.insert(scratch_.end(), undefined_.begin() + part[0],
                                    undefined_.begin() + part[0] + part[1]);
                break;
            case spv::OpVectorShuffle:
                for (std::uint32_t i = 0; i < operation.count; ++i) scratch_.push_back(undefined_[words[i]]);
                break;
            case spv::OpCompositeInsert:
                copy(operation.result, operands[1], operation.count, kAll);
                copy(operation.result + words[0], operands[0], words[1], kAll);
                return 0;
            case spv::OpSelect:  // only where both are unwritten, whichever is chosen
                for (std::uint32_t i = 0; i < operation.count; ++i)
                    scratch_.push_back(undefined_[operands[1] + i] & undefined_[operands[2] + i]);
                break;
            case spv::OpAccessChain:
                return 0;  // an address: nothing is read
            default:
                return compute(step);
        }
        std::copy(scratch_.begin(), scratch_.end(), undefined_.begin() + operation.result);
        return 0;
    }

    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes) {
        if (to == from) return;
        for (std::uint32_t i = 0; i < count; ++i)
            undefined_[to + i] = (undefined_[to + i] & ~lanes) | (undefined_[from + i] & lanes);
    }

    void gather(const Step& step, const Operation& operation) {
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            Lanes lanes = 0;
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if ((step.lanes >> lane & 1U) == 0) continue;
                const std::uint32_t from = address(step, operation.operands[0], operation.operands[1], lane);
                lanes |= undefined_[from + component] & Lanes{1} << lane;
            }
            undefined_[operation.result + component] = lanes;
        }
    }

    Lanes compute(const Step& step) {
        Lanes lanes = 0;
        for (const evaluate::Slice& operand : step.info().operands)
            lanes |= undefined_in(operand.slot, operand.count);
        std::fill_n(undefined_.begin() + step.info().result.slot, step.info().result.count, 0);
        return lanes & step.lanes;
    }

    const evaluate::Program& program_;
    std::vector<Lanes> undefined_;          ///< of each slot
    std::vector<Lanes> scratch_;            ///< an operation's result may share slots with its operands
    std::vector<std::uint32_t> followers_;  ///< of each operation: unobserved copies directly behind it
};

Lanes is_nan(const Step& step, const Slice& slice, Lanes lanes) {
    Lanes result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        for (std::uint32_t component = 0; component < slice.count && (lanes >> lane & 1U) != 0; ++component)
            if (std::isnan(float_row(step, slice, component)[lane])) result |= Lanes{1} << lane;
    return result;
}

/// "depth = 0", "(1, 0.5, 0.25)".
std::string value_text(const Step& step, const Slice& slice, std::size_t lane) {
    std::vector<float> components;
    for (std::uint32_t component = 0; component < slice.count; ++component) {
        const auto value = static_cast<float>(step.value(slice, component, lane));
        // The sign of a NaN means nothing, and is not the same on every machine.
        components.push_back(std::isnan(value) ? std::numeric_limits<float>::quiet_NaN() : value);
    }
    const std::string numbers = components.size() == 1 ? fmt::format("{}", components.front())
                                                       : fmt::format("({})", fmt::join(components, ", "));
    const std::string& name = step.program.names[slice.name];
    return name.empty() ? numbers : fmt::format("{} = {}", name, numbers);
}

/// "FDiv 1, depth = 0 -> inf".
std::string operation_text(const Step& step, std::size_t lane) {
    std::vector<std::string> operands;
    for (const Slice& operand : step.info().operands) operands.push_back(value_text(step, operand, lane));
    return fmt::format("{} {} -> {}", step.name(), fmt::join(operands, ", "),
                       value_text(step, step.info().result, lane));
}

/// One stage run on one machine.
struct Run {
    const evaluate::Program& program;
    const evaluate::Invocations& invocations;
    Machine machine;

    /// Fills a finding in at the first invocation that showed it. `at` is the operation where it happens.
    void show(Finding& finding, std::string_view message, std::string text, std::size_t invocation,
              std::optional<std::uint32_t> at) const {
        finding.message = message;
        finding.operation = std::move(text);
        finding.machine = machine;
        if (at) finding.place = program.place_of(*at);
        finding.point = point_of(program, invocations, invocation);
    }
};

/// An invocation left some component of an output unwritten.
struct Unwritten {
    std::size_t first_invocation = 0;  ///< of lane 0
    std::size_t output = 0;            ///< index into Program::outputs
    Lanes lanes = 0;
};

/// Watches every operation of a run. Cheap where no trap happens: whole rows of lanes are screened, and only
/// suspicious ones looked at.
class TrapObserver final : public evaluate::Observer<float> {
  public:
    /// `also`, unless it is null, sees every step too.
    TrapObserver(const Run& run, evaluate::Observer<float>* also)
        : run_(run), definedness_(run.program), also_(also) {
        for (std::size_t at = 0; at < run.program.operations.size(); ++at) {
            const evaluate::Row& row = evaluate::instruction_table()[run.program.operations[at].row];
            Watch& watch = watches_.emplace_back();
            watch.rules = rules_of(trap_rules(), row.code);
            watch.has_silent = std::any_of(watch.rules.begin(), watch.rules.end(),
                                           [](const TrapRule& rule) { return rule.is_silent; });
            // The other operations pass on what these made.
            watch.makes_floats =
                row.kind <= Kind::matrix && run.program.infos[at].result.scalar == evaluate::Scalar::float32;
        }
    }

    void after(const Step& step) override {
        if (!is_in_batch_ || step.first_invocation != batch_) begin_batch(step.first_invocation);
        if (const Lanes lanes = definedness_.after(step); lanes != 0)
            add(step, "a value is read before it is written", lanes);
        const Watch& watch = watches_[step.operation];
        if (watch.has_silent || watch.makes_floats) judge(step, watch);
        if (also_ != nullptr) also_->after(step);
    }

    void clamped(const Step& step, std::size_t lane, std::int64_t index, std::uint32_t extent) override {
        if (!is_in_batch_ || step.first_invocation != batch_) begin_batch(step.first_invocation);
        mark_trapped(Lanes{1} << lane);
        constexpr std::string_view kMessage = "array index out of bounds";
        Finding& finding = findings_[{step.operation, kMessage}];
        if (finding.points++ > 0) return;
        const std::string& array = step.program.names[step.info().result.name];
        run_.show(finding, kMessage, fmt::format("{}, index {} of {}", array, index, extent),
                  step.first_invocation + lane, step.operation);
    }

    /// To be called when the run is over.
    void finish() {
        if (!is_in_batch_) return;
        is_in_batch_ = false;
        for (std::size_t output = 0; output < run_.program.outputs.size(); ++output) {
            const evaluate::Port& port = run_.program.outputs[output];
            const Lanes lanes = definedness_.undefined_in(port.slot, port.components);
            if (lanes != 0) unwritten_.push_back({batch_, output, lanes});
        }
    }

    /// Whether the invocation met a trap.
    [[nodiscard]] bool trapped(std::size_t invocation) const {
        const std::size_t batch = invocation / kLanes;
        return batch < trapped_.size() && (trapped_[batch] >> invocation % kLanes & 1U) != 0;
    }
    /// By operation and message.
    [[nodiscard]] const std::map<std::pair<std::uint32_t, std::string_view>, Finding>& findings() const {
        return findings_;
    }
    /// Of every batch; discarded invocations among them.
    [[nodiscard]] const std::vector<Unwritten>& unwritten() const { return unwritten_; }

  private:
    /// How an operation is watched.
    struct Watch {
        std::span<const TrapRule> rules;
        bool has_silent = false;
        bool makes_floats = false;  ///< the result must be finite
    };

    void begin_batch(std::size_t first_invocation) {
        finish();
        is_in_batch_ = true;
        batch_ = first_invocation;
        definedness_.begin();
    }

    void judge(const Step& step, const Watch& watch) {
        Lanes told = 0;
        for (const TrapRule& rule : watch.rules) {
            if (!rule.is_silent) continue;
            const Lanes lanes = rule.happens_in(step) & ~told;
            if (lanes != 0) add(step, rule.message, lanes);
            told |= lanes;
        }
        if (watch.makes_floats) judge_result(step, watch, ~told);
    }

    /// A result that is not finite, though all operands are.
    void judge_result(const Step& step, const Watch& watch, Lanes lanes) {
        const Slice& result = step.info().result;
        lanes &= not_finite(step, result);
        for (const Slice& operand : step.info().operands)
            if (lanes != 0 && operand.scalar == evaluate::Scalar::float32)
                lanes &= ~not_finite(step, operand);
        if (lanes == 0) return;
        for (const TrapRule& rule : watch.rules) {
            if (rule.is_silent) continue;
            const Lanes explained = lanes & rule.happens_in(step);
            if (explained != 0) add(step, rule.message, explained);
            lanes &= ~explained;
        }
        const Lanes nan = is_nan(step, result, lanes);
        if (nan != 0) add(step, "a NaN made from finite numbers", nan);
        if ((lanes & ~nan) != 0) add(step, "an infinity made from finite numbers", lanes & ~nan);
    }

    void add(const Step& step, std::string_view message, Lanes lanes) {
        Finding& finding = findings_[{step.operation, message}];
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        if (finding.points == 0)
            run_.show(finding, message, operation_text(step, lane), step.first_invocation + lane,
                      step.operation);
        finding.points += static_cast<std::uint64_t>(std::popcount(lanes));
        mark_trapped(lanes);
    }

    void mark_trapped(Lanes lanes) {
        const std::size_t batch = batch_ / kLanes;
        if (batch >= trapped_.size()) trapped_.resize(batch + 1);
        trapped_[batch] |= lanes;
    }

    const Run& run_;
    std::vector<Watch> watches_;  ///< of each operation
    Definedness definedness_;
    evaluate::Observer<float>* also_;
    bool is_in_batch_ = false;
    std::size_t batch_ = 0;  ///< its first invocation
    std::map<std::pair<std::uint32_t, std::string_view>, Finding> findings_;
    std::vector<Unwritten> unwritten_;
    std::vector<Lanes> trapped_;  ///< of each batch up to the last in which anything trapped
};

/// The operation that last stores to the output; nothing where none does.
std::optional<std::uint32_t> last_store(const evaluate::Program& program, const evaluate::Port& port) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t at = 0; at < program.operations.size(); ++at) {
        const Slice& to = program.infos[at].result;
        const bool is_within = to.slot < port.slot + port.components && port.slot < to.slot + to.count;
        if (code_of(program.operations[at]) == spv::OpStore && is_within) found = at;
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
void add_unwritten(const evaluate::Outputs& outputs, const TrapObserver& observer, OutputFindings& findings) {
    for (const Unwritten& unwritten : observer.unwritten()) {
        const evaluate::Port& port = findings.run.program.outputs[unwritten.output];
        if (!must_be_written(findings.run.program, port)) continue;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t index = unwritten.first_invocation + lane;
            if ((unwritten.lanes >> lane & 1U) != 0 && index < outputs.count && !outputs.discarded[index])
                findings.add(port, "is not written on some path", index).machine = Machine::ieee;
        }
    }
}

/// Outputs beyond their bounds at points that neither trap nor are discarded.
void add_out_of_bounds(const evaluate::Outputs& outputs, const TrapObserver& observer,
                       std::span<const Interval> all, OutputFindings& findings) {
    const std::size_t components = all.size() / outputs.count;
    std::size_t component = 0;
    for (const evaluate::Port& port : findings.run.program.outputs) {
        const std::vector<double>& values = outputs.values.at(port.name);
        for (std::uint32_t c = 0; c < port.components; ++c, ++component)
            for (std::size_t i = 0; i < outputs.count; ++i) {
                const double value = values[c * outputs.count + i];
                const Interval& bounds = all[i * components + component];
                if (value >= bounds.low && value <= bounds.high) continue;
                if (outputs.discarded[i] || observer.trapped(i)) continue;
                findings.add(port, fault_of(value, bounds), i,
                             fmt::format("{} is not within [{}, {}]", static_cast<float>(value),
                                         static_cast<float>(bounds.low), static_cast<float>(bounds.high)));
            }
    }
}

}  // namespace

Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                        const evaluate::Invocations& invocations, Machine machine,
                                        std::span<const Interval> bounds, evaluate::Observer<float>* also) {
    const Run run{program, invocations, machine};
    TrapObserver observer(run, also);
    GOBO_TRY(const auto outputs, evaluate::run<float>(program, invocations, options_of(machine), &observer));
    observer.finish();
    OutputFindings of_outputs{run};
    add_unwritten(outputs, observer, of_outputs);
    if (!bounds.empty()) add_out_of_bounds(outputs, observer, bounds, of_outputs);
    std::vector<Finding> findings;
    for (auto& [message, finding] : of_outputs.by_message) findings.push_back(std::move(finding));
    for (const auto& [where, finding] : observer.findings()) findings.push_back(finding);
    return findings;
}

std::string to_text(const Finding& finding) {
    std::string text = finding.message;
    if (!finding.operation.empty()) text += ": " + finding.operation;
    if (finding.machine != Machine::ieee) text += fmt::format(", machine {}", name_of(finding.machine));
    return text;
}

std::string eval_input(const Finding& finding, const std::string& heading) {
    const std::string place = fmt::format("{}:{}", finding.place.file, finding.place.line);
    return evaluate::eval_file(gobo::name_of(finding.stage), finding.point,
                               {heading, fmt::format("{}: {}", place, to_text(finding))},
                               evaluate::Digits::of_float);
}

}  // namespace gobo::sanitize
