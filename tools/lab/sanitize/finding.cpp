#include "lab/sanitize/finding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/ranges.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/eval_report.hpp"
#include "lab/evaluate/half.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/image_rules.hpp"
#include "lab/sanitize/lost_numbers.hpp"
#include "lab/sanitize/output_findings.hpp"
#include "lab/sanitize/step_text.hpp"
#include "lab/sanitize/taint.hpp"
#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using evaluate::Operation;
using evaluate::Slice;
using Step = evaluate::Step<float>;

Lanes is_nan(const Step& step, const Slice& slice, Lanes lanes) {
    Lanes result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        for (std::uint32_t component = 0; component < slice.count && (lanes >> lane & 1U) != 0; ++component)
            if (std::isnan(float_row(step, slice, component)[lane])) result |= Lanes{1} << lane;
    return result;
}

/// Whether the operation, which does not compute floats, makes 16-bit ones of those that it passes on where
/// they are mediump.
bool may_narrow(const evaluate::Row& row) {
    switch (row.kind) {
        case Kind::convert:
            return row.code == spv::OpConvertSToF || row.code == spv::OpConvertUToF;
        case Kind::move:
            return row.code != spv::OpAccessChain;
        default:
            return row.kind == Kind::load || row.kind == Kind::store || row.kind == Kind::select ||
                   row.kind == Kind::image || row.kind == Kind::derivative;
    }
}

/// Whether the operation reads what is mediump of an input or a uniform, which may be given more than a
/// 16-bit float holds.
bool reads_mediump_input(const evaluate::Program& program, std::size_t operation) {
    const evaluate::OperationInfo& info = program.infos[operation];
    if (row_of(program.operations[operation]).code != spv::OpLoad || !info.is_relaxed ||
        info.operands.empty())
        return false;
    const auto holds = [&](const evaluate::Port& port) {
        return port.slot <= info.operands.front().slot &&
               info.operands.front().slot < port.slot + port.components;
    };
    return std::ranges::any_of(program.inputs, holds) || std::ranges::any_of(program.uniforms, holds);
}

/// The lanes in which what is stored is a number that no 16-bit float holds.
Lanes beyond_half(const Step& step) {
    const Slice& stored = step.info().operands.front();
    Lanes result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        for (std::uint32_t component = 0; component < stored.count; ++component)
            if (std::isinf(evaluate::rounded_to_half(float_row(step, stored, component)[lane])))
                result |= Lanes{1} << lane;
    return result & step.lanes;
}

constexpr std::string_view kReadUnwritten = "a value is read before it is written";
constexpr std::string_view kNoReturn = "a function returns no value on some path";

/// Watches every operation of a run. Cheap where no trap happens: whole rows of lanes are screened, and only
/// suspicious ones looked at.
class TrapObserver final : public evaluate::Observer<float> {
  public:
    /// `also`, unless it is null, sees every step too.
    TrapObserver(const Run& run, evaluate::Observer<float>* also)
        : run_(run), ports_(written_ports(run.program)), taint_(run.program), also_(also) {
        for (std::size_t at = 0; at < run.program.operations.size(); ++at) {
            const evaluate::Row& row = evaluate::instruction_table()[run.program.operations[at].row];
            Watch& watch = watches_.emplace_back();
            watch.rules = rules_of(trap_rules(), row.code);
            watch.has_silent = std::any_of(watch.rules.begin(), watch.rules.end(),
                                           [](const TrapRule& rule) { return rule.is_silent; });
            const evaluate::OperationInfo& info = run.program.infos[at];
            const bool is_half = options_of(run.machine).is_half;
            watch.narrows = is_half && narrows_to_half(run.program, at);
            // The other operations pass on what these made.
            watch.reads_mediump_input = is_half && reads_mediump_input(run.program, at);
            watch.makes_floats =
                (row.kind <= Kind::matrix || watch.narrows) && evaluate::is_float(info.result.scalar);
            watch.first_decider = first_decider(row);
            watch.is_of_image = row.kind == Kind::image || row.kind == Kind::derivative;
        }
    }

    void begins(std::size_t first_invocation) override {
        finish();
        is_in_batch_ = true;
        batch_ = first_invocation;
        callers_lanes_ = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (batch_ + lane < run_.invocations.count) callers_lanes_ |= Lanes{1} << lane;
        taint_.begin();
    }

    void after(const Step& step) override {
        const Watch& watch = watches_[step.operation];
        hits_.clear();
        if (watch.has_silent || watch.makes_floats) judge(step, watch);
        if (watch.is_of_image)
            for (const ImageFault& fault : image_faults(step, run_.invocations, callers_lanes_))
                hits_.push_back({fault.message, fault.lanes});
        tell_hits(step);
        if (watch.first_decider) reach_by_operand(step, *watch.first_decider);
        taint_.after(step);
        if (taint_.used() != 0) keep_text(step);
        for (const Hit& hit : hits_) taint_.mark(step, hit.lanes, {Cause::Kind::trap, hit.trap});
        for (const Hit& hit : clamped_) taint_.mark(step, hit.lanes, {Cause::Kind::trap, hit.trap});
        clamped_.clear();
        if (also_ != nullptr) also_->after(step);
    }

    void clamped(const Step& step, std::size_t lane, std::int64_t index, std::uint32_t extent) override {
        const Lanes lanes = Lanes{1} << lane;
        mark_trapped(lanes);
        constexpr std::string_view kMessage = "array index out of bounds";
        const std::string& array = step.program.names[step.info().result.name];
        const std::string text = fmt::format("{}, index {} of {}", array, index, extent);
        if ((taint_.operands_of(step) & lanes) != 0)
            return follow(step, kMessage, text, lane, taint_.operand_cause(step, lane));
        const std::size_t trap = trap_of(step.operation, kMessage, text, step.first_invocation + lane);
        count(trap, batch_ / kLanes, lanes);
        clamped_.push_back({kMessage, lanes, trap});
    }

    bool gives_up(const evaluate::Block& loop, Lanes lanes, std::size_t first_invocation) override {
        if (lanes == 0) return true;
        mark_trapped(lanes);
        // Numbered behind what reach() tells of.
        const evaluate::Program& program = run_.program;
        const std::size_t number =
            program.operations.size() + program.undefined.size() + program.places.size() + loop.place;
        const std::size_t trap = trap_without_operation(
            static_cast<std::uint32_t>(number), kEndless, {},
            first_invocation + static_cast<std::size_t>(std::countr_zero(lanes)), program.places[loop.place]);
        count(trap, batch_ / kLanes, lanes);
        return true;
    }

    void ends(const evaluate::Block& block, Lanes lanes) override {
        using End = evaluate::Block::End;
        if (block.end != End::branch && block.end != End::select) return;
        const Lanes undefined = taint_.lanes_of(block.condition, 1) & lanes;
        for (std::size_t lane = 0; lane < kLanes && undefined != 0; ++lane)
            if ((undefined >> lane & 1U) != 0)
                reach(taint_.cause_of(block.condition, 1, lane), lane, block.place);
    }

    void copied(const Operation& copy, Lanes lanes) override { taint_.copied(copy, lanes); }

    /// To be called when the run is over.
    void finish() {
        if (!is_in_batch_) return;
        for (std::size_t output = 0; output < ports_.size(); ++output) {
            const evaluate::Port& port = *ports_[output];
            const Lanes lanes = taint_.lanes_of(port.slot, port.components);
            for (std::size_t lane = 0; lane < kLanes && lanes != 0; ++lane)
                if ((lanes >> lane & 1U) != 0) finish_output(output, port, lane);
        }
        is_in_batch_ = false;
    }
    /// To be called then with what the run gave: what nobody wrote matters once it is an output.
    void judge_outputs(const evaluate::Outputs& outputs);

    /// Whether the invocation met a trap.
    [[nodiscard]] bool trapped(std::size_t invocation) const { return is_marked(trapped_, invocation); }
    /// Whether an output of the invocation comes of a constant that is no finite number.
    [[nodiscard]] bool is_of_constants(std::size_t invocation) const {
        return is_marked(of_constants_, invocation);
    }
    [[nodiscard]] const std::vector<Finding>& findings() const { return traps_; }
    /// Of every batch; discarded invocations among them.
    [[nodiscard]] const std::vector<UndefinedOutput>& undefined_outputs() const { return undefined_; }

  private:
    /// How an operation is watched.
    struct Watch {
        std::span<const TrapRule> rules;
        bool has_silent = false;
        bool makes_floats = false;         ///< the result must be finite
        bool narrows = false;              ///< what is only passed on becomes a 16-bit float
        bool reads_mediump_input = false;  ///< which may be given more than 16 bits hold
        bool is_of_image = false;          ///< a texture function, or a derivative
        /// The first operand that decides what is read, so that it must be defined; nothing where none does.
        std::optional<std::size_t> first_decider;
    };
    /// A rule that happened.
    struct Hit {
        std::string_view message;
        Lanes lanes = 0;
        std::size_t trap = 0;  ///< index into traps_
    };

    static std::optional<std::size_t> first_decider(const evaluate::Row& row) {
        if (row.code == spv::OpAccessChain) return 0;
        if (row.kind == Kind::image || row.code == spv::OpVectorExtractDynamic) return 1;
        if (row.code == spv::OpVectorInsertDynamic) return 2;
        return std::nullopt;
    }

    [[nodiscard]] static bool is_marked(const std::vector<Lanes>& batches, std::size_t invocation) {
        const std::size_t batch = invocation / kLanes;
        return batch < batches.size() && (batches[batch] >> invocation % kLanes & 1U) != 0;
    }

    void judge(const Step& step, const Watch& watch) {
        Lanes told = 0;
        for (const TrapRule& rule : watch.rules) {
            if (!rule.is_silent) continue;
            const Lanes lanes = rule.happens_in(step) & ~told;
            if (lanes != 0) hits_.push_back({rule.message, lanes});
            told |= lanes;
        }
        if (watch.makes_floats) judge_result(step, watch, ~told);
    }

    /// A result that is not finite, though all operands are.
    void judge_result(const Step& step, const Watch& watch, Lanes lanes) {
        Slice result = step.info().result;
        // The second half of what frexp() gives are integers.
        if (step.row().code == evaluate::kExtended + GLSLstd450FrexpStruct)
            result.count = step.program.operations[step.operation].count;
        lanes &=
            watch.narrows && step.row().kind == Kind::store ? beyond_half(step) : not_finite(step, result);
        if (!watch.reads_mediump_input)
            for (const Slice& operand : step.info().operands)
                if (lanes != 0 && evaluate::is_float(operand.scalar)) lanes &= ~not_finite(step, operand);
        if (lanes == 0) return;
        for (const TrapRule& rule : watch.rules) {
            if (rule.is_silent) continue;
            const Lanes explained = lanes & rule.happens_in(step);
            if (explained != 0) hits_.push_back({rule.message, explained});
            lanes &= ~explained;
        }
        const Lanes nan = is_nan(step, result, lanes);
        if (nan != 0) hits_.push_back({"a NaN made from finite numbers", nan});
        if ((lanes & ~nan) != 0) hits_.push_back({"an infinity made from finite numbers", lanes & ~nan});
    }

    /// Those whose operands are defined are traps of their own, the others follow from an earlier one.
    void tell_hits(const Step& step) {
        if (hits_.empty()) return;
        const Lanes undefined = taint_.operands_of(step);
        for (Hit& hit : hits_) {
            mark_trapped(hit.lanes);
            for (std::size_t lane = 0; lane < kLanes && (hit.lanes & undefined) != 0; ++lane)
                if ((hit.lanes & undefined & Lanes{1} << lane) != 0)
                    follow(step, hit.message, {}, lane, taint_.operand_cause(step, lane));
            hit.lanes &= ~undefined;
            if (hit.lanes == 0) continue;
            const auto lane = static_cast<std::size_t>(std::countr_zero(hit.lanes));
            hit.trap = trap_of(step.operation, hit.message, {}, step.first_invocation + lane);
            Finding& finding = traps_[hit.trap];
            if (finding.points == 0) finding.operation = operation_text(step, lane);
            count(hit.trap, batch_ / kLanes, hit.lanes);
        }
        std::erase_if(hits_, [](const Hit& hit) { return hit.lanes == 0; });
    }

    /// The trap of that operation and message, new ones filled in but for their number of points.
    std::size_t trap_of(std::uint32_t operation, std::string_view message, std::string text,
                        std::size_t invocation) {
        const auto [known, is_new] = trap_index_.try_emplace({operation, message}, traps_.size());
        if (is_new) run_.show(traps_.emplace_back(), message, std::move(text), invocation, operation);
        return known->second;
    }

    /// What happens in a lane because of an earlier cause is told beneath that one.
    void follow(const Step& step, std::string_view message, std::string text, std::size_t lane,
                const Cause& cause) {
        std::optional<std::size_t> trap;
        if (cause.kind == Cause::Kind::trap)
            trap = cause.index;
        else if (cause.kind != Cause::Kind::constant)
            trap = reach(cause, lane, step.info().place);
        if (!trap) return;
        std::vector<Consequence>& known = traps_[*trap].consequences;
        const Place& place = step.place();
        if (place == traps_[*trap].place && message == traps_[*trap].message) return;
        const auto is_same = [&](const Consequence& one) {
            return one.place == place && one.message == message;
        };
        if (known.size() >= kMostConsequences || std::any_of(known.begin(), known.end(), is_same)) return;
        if (text.empty()) text = operation_text(step, lane);
        known.push_back({place, std::string(message), std::move(text)});
    }

    /// What nobody wrote came to matter in a lane: its finding. `place` is told where it was only copied.
    std::optional<std::size_t> reach(const Cause& cause, std::size_t lane, std::uint32_t place) {
        return reach(cause, taint_.first_use(cause, lane), batch_ + lane, place);
    }
    std::optional<std::size_t> reach(const Cause& cause, std::optional<std::uint32_t> first_use,
                                     std::size_t invocation, std::uint32_t place) {
        const evaluate::Program& program = run_.program;
        const auto operations = static_cast<std::uint32_t>(program.operations.size());
        std::size_t trap = 0;
        if (cause.kind == Cause::Kind::no_return) {
            const evaluate::UndefinedValue& value = program.undefined[cause.index];
            trap = trap_without_operation(operations + static_cast<std::uint32_t>(cause.index), kNoReturn,
                                          value.function + "()", invocation, program.places[value.place]);
        } else if (cause.kind != Cause::Kind::unwritten) {
            return std::nullopt;
        } else if (first_use) {
            trap = trap_of(*first_use, kReadUnwritten, texts_[*first_use], invocation);
        } else {
            const auto undefined = static_cast<std::uint32_t>(program.undefined.size());
            trap = trap_without_operation(operations + undefined + place, kReadUnwritten, {}, invocation,
                                          program.places[place]);
        }
        const std::size_t batch = invocation / kLanes;
        const Lanes lane = Lanes{1} << invocation % kLanes;
        count(trap, batch, lane);
        mark(trapped_, batch, lane);
        return trap;
    }

    std::size_t trap_without_operation(std::uint32_t number, std::string_view message, std::string text,
                                       std::size_t invocation, const Place& place) {
        const auto [known, is_new] = trap_index_.try_emplace({number, message}, traps_.size());
        if (is_new) {
            run_.show(traps_.emplace_back(), message, std::move(text), invocation, std::nullopt);
            traps_.back().place = place;
        }
        return known->second;
    }

    /// Operands that decide what is read must be defined.
    void reach_by_operand(const Step& step, std::size_t first) {
        const auto& operands = step.info().operands;
        for (std::size_t i = first; i < operands.size(); ++i) {
            const Lanes undefined = taint_.lanes_of(operands[i]) & step.lanes;
            for (std::size_t lane = 0; lane < kLanes && undefined != 0; ++lane)
                if ((undefined >> lane & 1U) != 0)
                    reach(taint_.cause_of(operands[i].slot, operands[i].count, lane), lane,
                          step.info().place);
        }
    }

    void finish_output(std::size_t output, const evaluate::Port& port, std::size_t lane) {
        std::uint32_t component = 0;
        while ((taint_.lanes_of(port.slot + component, 1) >> lane & 1U) == 0) ++component;
        const Cause& cause = taint_.cause_of(port.slot + component, 1, lane);
        if (cause.kind == Cause::Kind::constant) mark(of_constants_, batch_ / kLanes, Lanes{1} << lane);
        if (cause.kind != Cause::Kind::unwritten && cause.kind != Cause::Kind::no_return) return;
        bool is_unwritten = false;
        if (cause.kind == Cause::Kind::unwritten) {
            const auto& [slot, count] = run_.program.variables[cause.index];
            is_unwritten = slot <= port.slot && port.slot < slot + count;
        }
        const auto first_use = taint_.first_use(cause, lane);
        if (!undefined_.empty()) {
            UndefinedOutput& last = undefined_.back();
            if (last.first_invocation == batch_ && last.output == output && last.component == component &&
                last.first_use == first_use && last.cause.kind == cause.kind &&
                last.cause.index == cause.index) {
                last.lanes |= Lanes{1} << lane;
                return;
            }
        }
        undefined_.push_back(
            {batch_, output, component, Lanes{1} << lane, cause, first_use, is_unwritten && !first_use});
    }

    void keep_text(const Step& step) {
        const auto [known, is_new] = texts_.try_emplace(step.operation);
        const Lanes lanes = taint_.used() & step.lanes;
        if (is_new && lanes != 0)
            known->second = operation_text(step, static_cast<std::size_t>(std::countr_zero(lanes)));
    }

    /// The first trap of the same place and message.
    std::size_t first_alike(std::size_t trap) {
        while (alike_.size() <= trap) {
            const Finding& next = traps_[alike_.size()];
            const auto is_alike = [&](const Finding& one) {
                return one.place == next.place && one.message == next.message;
            };
            alike_.push_back(
                static_cast<std::size_t>(std::ranges::find_if(traps_, is_alike) - traps_.begin()));
        }
        return alike_[trap];
    }

    /// A point counts once for a place and message, however often a loop, a call or another operation of the
    /// line runs into it.
    void count(std::size_t trap, std::size_t batch, Lanes lanes) {
        std::vector<Lanes>& counted = counted_[first_alike(trap)];
        if (batch < counted.size()) lanes &= ~counted[batch];
        traps_[trap].points += static_cast<std::uint64_t>(std::popcount(lanes));
        mark(counted, batch, lanes);
    }

    void mark_trapped(Lanes lanes) { mark(trapped_, batch_ / kLanes, lanes); }
    static void mark(std::vector<Lanes>& batches, std::size_t batch, Lanes lanes) {
        if (batch >= batches.size()) batches.resize(batch + 1);
        batches[batch] |= lanes;
    }

    static constexpr std::size_t kMostConsequences = 8;  ///< told beneath a finding

    const Run& run_;
    std::vector<const evaluate::Port*> ports_;
    std::vector<Watch> watches_;  ///< of each operation
    Taint taint_;
    evaluate::Observer<float>* also_;
    bool is_in_batch_ = false;
    std::size_t batch_ = 0;       ///< its first invocation
    Lanes callers_lanes_ = 0;     ///< of the batch: those that are invocations at all
    std::vector<Hit> hits_;       ///< of the step at hand
    std::vector<Hit> clamped_;    ///< indices of the step at hand
    std::vector<Finding> traps_;  ///< in the order in which they first happened
    std::map<std::pair<std::uint32_t, std::string_view>, std::size_t>
        trap_index_;                  ///< by operation and message
    std::vector<std::size_t> alike_;  ///< of each trap, as first_alike() has it
    std::map<std::size_t, std::vector<Lanes>>
        counted_;  ///< of such a first trap: lanes of each batch it was counted in
    std::map<std::uint32_t, std::string> texts_;  ///< of operations that first used what nobody wrote
    std::vector<UndefinedOutput> undefined_;
    std::vector<Lanes> trapped_;       ///< of each batch up to the last in which anything trapped
    std::vector<Lanes> of_constants_;  ///< likewise
};

void TrapObserver::judge_outputs(const evaluate::Outputs& outputs) {
    for (const UndefinedOutput& undefined : undefined_) {
        evaluate::Port port = *ports_[undefined.output];
        if (undefined.is_unwritten || !must_be_written(run_.program, port)) continue;
        port.slot += undefined.component;
        port.components = 1;
        const std::optional<std::uint32_t> store = last_store(run_.program, port);
        const std::uint32_t place = store ? run_.program.infos[*store].place : 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t index = undefined.first_invocation + lane;
            if ((undefined.lanes >> lane & 1U) != 0 && index < outputs.count && !outputs.discarded[index])
                reach(undefined.cause, undefined.first_use, index, place);
        }
    }
}

/// Numbers that 16 bits lose, at points that do not trap.
Result<std::vector<Finding>> lost_numbers(const Run& run, const evaluate::Options& options,
                                          const evaluate::Outputs& outputs, const TrapObserver& observer) {
    const auto is_judged = [&](std::size_t invocation) { return !observer.trapped(invocation); };
    GOBO_TRY(const auto lost, find_lost_numbers(run.program, run.invocations, options, outputs, is_judged));
    std::vector<Finding> findings;
    for (const LostNumber& one : lost) {
        Finding& finding = findings.emplace_back();
        run.show(finding, kLostNumber, one.text, one.invocation, one.operation);
        finding.points = one.points;
    }
    return findings;
}

}  // namespace

bool narrows_to_half(const evaluate::Program& program, std::size_t operation) {
    return program.infos[operation].is_relaxed && may_narrow(evaluate::row_of(program.operations[operation]));
}

Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                        const evaluate::Invocations& invocations, Machine machine,
                                        std::span<const Interval> bounds, evaluate::Observer<float>* also) {
    const Run run{program, invocations, machine};
    TrapObserver observer(run, also);
    evaluate::Options options = options_of(machine);
    options.iteration_limit = evaluate::kMostIterations;
    GOBO_TRY(const auto outputs, evaluate::run<float>(program, invocations, options, &observer));
    observer.finish();
    observer.judge_outputs(outputs);
    const auto is_trapped = [&](std::size_t invocation) { return observer.trapped(invocation); };
    const auto is_of_constants = [&](std::size_t invocation) { return observer.is_of_constants(invocation); };
    std::vector<Finding> findings =
        output_findings(run, outputs, {observer.undefined_outputs(), is_trapped, is_of_constants}, bounds);
    for (const Finding& finding : observer.findings())
        if (finding.points > 0 || !finding.consequences.empty()) findings.push_back(finding);
    if (options.is_half) {
        GOBO_TRY(const auto lost, lost_numbers(run, options, outputs, observer));
        findings.insert(findings.end(), lost.begin(), lost.end());
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
    const std::string place = fmt::format("{}:{}", finding.place.file, finding.place.line);
    return evaluate::eval_file(gobo::name_of(finding.stage), finding.point,
                               {heading, fmt::format("{}: {}", place, to_text(finding))},
                               evaluate::Digits::of_float);
}

}  // namespace gobo::sanitize
