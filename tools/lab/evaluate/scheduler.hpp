// Runs the blocks of a program for the lanes of one batch, in any arithmetic that compilers of GLSL may make.
// Internal to evaluation.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/half.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/registers.hpp"

namespace gobo::evaluate {

/// Remembers of each slot and lane of which two numbers its value is the product (fused) or the sum
/// (regrouped, reordered), wherever it has been copied since, and computes later additions from those:
/// across variables, calls and turns of loops, as a compiler sees them once it has inlined and unrolled all.
/// Neither what `precise` marks is regrouped, nor the parts of what it marks.
template <class T>
class Regrouping {
  public:
    Regrouping(const Program& program, Registers<T>& registers, Sums sums)
        : program_(program),
          registers_(registers),
          sums_(sums),
          parts_(std::size_t{program.slots} * kLanes),
          known_(program.slots, 0) {}

    /// Nothing is known of any slot.
    void begin() { std::fill(known_.begin(), known_.end(), 0); }

    /// Computes the operation, of index `at`, where it is an addition whose parts are known. False: the
    /// operation is to be run as always, and after() to be called.
    [[nodiscard]] bool takes_over(std::uint32_t at) {
        const Operation& operation = program_.operations[at];
        const std::uint32_t code = row_of(operation).code;
        if (program_.infos[at].is_precise || (code != spv::OpFAdd && code != spv::OpFSub)) return false;
        add(operation, code == spv::OpFSub);
        return true;
    }

    void after(std::uint32_t at) {
        const Operation& operation = program_.operations[at];
        const Slice& result = program_.infos[at].result;
        const std::uint32_t code = row_of(operation).code;
        const std::uint32_t* words = registers_.words(operation);
        const bool is_free = !program_.infos[at].is_precise;
        switch (code) {
            case spv::OpFMul:
            case spv::OpVectorTimesScalar:
            case spv::OpMatrixTimesScalar:
                if (is_free && sums_ == Sums::fused) return remember(operation, code != spv::OpFMul);
                break;
            case spv::OpFNegate:
                if (is_free) return negate(operation);
                break;
            case kCopy:
            case spv::OpStore:
                return copy(operation);
            case spv::OpLoad:
            case spv::OpCompositeExtract:
                return copy(operation.result, operation.operands[0], operation.count, kAllLanes);
            case spv::OpCompositeConstruct: {
                std::uint32_t to = operation.result;
                for (std::uint32_t word = 0; word < operation.extras; to += words[word + 1], word += 2)
                    copy(to, words[word], words[word + 1], kAllLanes);
                return;
            }
            case spv::OpCompositeInsert:
                copy(operation.result, operation.operands[1], operation.count, kAllLanes);
                return copy(operation.result + words[0], operation.operands[0], words[1], kAllLanes);
            case spv::OpVectorShuffle:
                for (std::uint32_t component = 0; component < operation.count; ++component)
                    copy(operation.result + component, words[component], 1, kAllLanes);
                return;
            case kScatter:
                for (std::uint32_t component = 0; component < operation.count; ++component)
                    for (std::size_t lane = 0; lane < kLanes; ++lane) {
                        const auto offset =
                            static_cast<std::uint32_t>(registers_.ints(operation.operands[1])[lane]);
                        known_[operation.result + component + offset] &= ~(LaneMask{1} << lane);
                    }
                return;
            case kExtended + GLSLstd450ModfStruct:
            case kExtended + GLSLstd450FrexpStruct:
                return forget(operation.result, 2 * operation.count);
            default:
                break;
        }
        forget(result.slot, result.count);
    }

    /// The active lanes have been copied.
    void copy(const Operation& operation) {
        copy(operation.result, operation.operands[0], operation.count, registers_.active());
    }

  private:
    struct Parts {
        T first;
        T second;
    };
    [[nodiscard]] Parts* parts(std::uint32_t slot) { return parts_.data() + std::size_t{slot} * kLanes; }

    /// The factors of a product, of all lanes.
    void remember(const Operation& operation, bool is_scaled) {
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            const T* a = registers_.floats(operation.operands[0] + component);
            const T* b = registers_.floats(operation.operands[1] + (is_scaled ? 0 : component));
            Parts* known = parts(operation.result + component);
            for (std::size_t lane = 0; lane < kLanes; ++lane) known[lane] = {a[lane], b[lane]};
            known_[operation.result + component] = kAllLanes;
        }
    }

    /// -(a b) is (-a) b, and -(a + b) is (-a) + (-b).
    void negate(const Operation& operation) {
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            const Parts* from = parts(operation.operands[0] + component);
            Parts* to = parts(operation.result + component);
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                to[lane] = {-from[lane].first, sums_ == Sums::fused ? from[lane].second : -from[lane].second};
            known_[operation.result + component] = known_[operation.operands[0] + component];
        }
    }

    void forget(std::uint32_t slot, std::uint32_t count) { std::fill_n(known_.begin() + slot, count, 0); }

    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, LaneMask lanes) {
        if (to == from) return;
        for (std::uint32_t component = 0; component < count; ++component) {
            const LaneMask copied = known_[from + component] & lanes;
            known_[to + component] = (known_[to + component] & ~lanes) | copied;
            for (std::size_t lane = 0; lane < kLanes && copied != 0; ++lane)
                if (has_lane(copied, lane)) parts(to + component)[lane] = parts(from + component)[lane];
        }
    }

    void add(const Operation& operation, bool is_difference) {
        forget(operation.result, operation.count);
        for (std::uint32_t component = 0; component < operation.count; ++component)
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                add_lane(operation, component, lane, is_difference ? T(-1) : T(1));
    }

    /// x + sign y, from the parts of x where they are known, otherwise from those of y.
    void add_lane(const Operation& operation, std::uint32_t component, std::size_t lane, T sign) {
        const std::uint32_t slots[] = {operation.operands[0] + component, operation.operands[1] + component};
        const std::uint32_t to = operation.result + component;
        const T x = registers_.floats(slots[0])[lane];
        const T y = sign * registers_.floats(slots[1])[lane];
        T& result = registers_.floats(to)[lane];
        const bool knows_x = has_lane(known_[slots[0]], lane);
        const bool knows_y = has_lane(known_[slots[1]], lane);
        Parts of = knows_x ? parts(slots[0])[lane] : parts(slots[1])[lane];
        if (sums_ == Sums::fused) {
            const T factor = knows_x ? of.first : sign * of.first;
            result = knows_x || knows_y ? std::fma(factor, of.second, knows_x ? y : x) : x + y;
            return;
        }
        if (!knows_x) of = {sign * of.first, sign * of.second};
        Parts now{x, y};
        if (knows_x || knows_y)
            now = regroup(of, knows_x ? y : x, result);
        else
            result = x + y;
        parts(to)[lane] = now;
        known_[to] |= LaneMask{1} << lane;
    }

    /// (first + second) + other; the parts of the sum. What cancels is not computed at all.
    Parts regroup(Parts known, T other, T& sum) const {
        if (other == -known.first)
            known = {known.second, T(0)};
        else if (other == -known.second)
            known = {known.first, T(0)};
        else if (sums_ == Sums::regrouped)
            known = {known.first, known.second + other};
        else
            known = {known.first + other, known.second};
        sum = known.first + known.second;
        return known;
    }

    const Program& program_;
    Registers<T>& registers_;
    Sums sums_;
    std::vector<Parts> parts_;     ///< of each slot and lane
    std::vector<LaneMask> known_;  ///< of each slot: lanes with parts
};

/// What becomes of small numbers in the `number`-th of the constants and operations.
inline SmallHalves small_halves(const Options& options, std::size_t number, std::size_t invocation) {
    const std::vector<std::uint32_t>* const lose = options.loses_small;
    if (lose != nullptr && number >= (*lose)[std::min(invocation, lose->size() - 1)])
        return SmallHalves::kept;
    return options.flush_denormals ? SmallHalves::flushed : SmallHalves::gradual;
}

/// How the row runs in the arithmetic of these options.
inline const Execution& execution_of(const Row& row, const Options& options) {
    const Liberties& liberties = row.liberties;
    const Execution* chosen = &row.execution;
    const auto prefer = [&](bool is_wanted, const Execution& other) {
        if (is_wanted && other.in_float != nullptr) chosen = &other;
    };
    prefer(options.nans == NaNs::kept, liberties.nan_kept);
    prefer(options.nans == NaNs::dropped, liberties.nan_dropped);
    prefer(options.sums == Sums::fused, liberties.fused);
    prefer(options.sums == Sums::regrouped || options.sums == Sums::reordered, liberties.backwards);
    return *chosen;
}

/// Moves the operation's result, of so many components, by the largest error allowed, up or down.
template <class T>
void add_largest_error(const Row& row, const Operation& operation, std::uint32_t components,
                       Registers<T>& registers, bool is_upward) {
    T* result = registers.floats(operation.result);
    const T* x = registers.floats(operation.operands[0]);
    const T* y = registers.floats(operation.operands[1]);  // of functions of one operand nobody's slot 0
    for (std::size_t i = 0; i < components * kLanes; ++i) {
        if (!registers.is_active(i % kLanes) || !std::isfinite(result[i])) continue;
        const double error = row.liberties.largest_error(static_cast<double>(x[i]), static_cast<double>(y[i]),
                                                         static_cast<double>(result[i]));
        const double moved = static_cast<double>(result[i]) + (is_upward ? error : -error);
        // An exponential or a root is never negative, and an error makes no infinity.
        const bool may_be_negative = row.kind == Kind::log || row.kind == Kind::trig || result[i] < 0;
        if ((moved >= 0 || may_be_negative) &&
            std::fabs(moved) <= static_cast<double>(std::numeric_limits<float>::max()))
            result[i] = static_cast<T>(moved);
    }
}

/// Lanes go through blocks together as long as they agree. Where they part, those at the earliest block run
/// first; the order of blocks (see structured_order()) makes them meet again where their ways join.
template <class T>
class Scheduler {
  public:
    Scheduler(const Program& program, Registers<T>& registers, const Options& options, Observer<T>* observer)
        : program_(program), registers_(registers), options_(options), observer_(observer) {
        for (const Row& row : instruction_table()) rows_.push_back(execution_of(row, options).in<T>());
        if (options.sums != Sums::as_written) regrouping_.emplace(program, registers, options.sums);
        loop_visits_.resize(program.blocks.size());
        if (options.count) lane_visits_.resize(program.blocks.size());
    }

    /// Runs all lanes from the first block to the end. An endless loop is an
    /// error at its place.
    [[nodiscard]] std::optional<Diagnostic> run() {
        std::fill(loop_visits_.begin(), loop_visits_.end(), 0);
        for (auto& visits : lane_visits_) visits.fill(0);
        if (regrouping_) regrouping_->begin();
        discarded_ = 0;
        waiting_ = 0;
        earliest_ = Program::kEnd;
        current_ = 0;
        registers_.set_active(kAllLanes);
        while (current_ != Program::kEnd) {
            const Block& block = program_.blocks[current_];
            if (block.is_loop && ++loop_visits_[current_] > options_.iteration_limit) {
                const LaneMask lanes = registers_.active();
                if (observer_ == nullptr || !observer_->gives_up(block, lanes & registers_.callers_lanes,
                                                                 registers_.first_invocation))
                    return error_at(
                        program_.places[block.place],
                        fmt::format("a loop takes more than {} iterations", options_.iteration_limit));
                discarded_ |= lanes;
                go(Program::kEnd);
                continue;
            }
            if (!lane_visits_.empty()) count_visit(current_);
            if (observer_ != nullptr || options_.rounded_in != nullptr)
                run_observed(block);
            else if (regrouping_ || options_.errors != Errors::none || options_.is_half ||
                     program_.has_narrow || options_.is_single)
                for (std::uint32_t at = block.first; at < block.first + block.count; ++at) execute_at(at);
            else
                for (const Operation& operation :
                     std::span(program_.quick).subspan(block.quick_first, block.quick_count))
                    execute(operation);
            if (observer_ != nullptr) observer_->ends(block, registers_.active() & registers_.callers_lanes);
            leave(block);
        }
        return std::nullopt;
    }

    [[nodiscard]] LaneMask discarded() const { return discarded_; }
    /// Adds what the lane executed in the last run.
    void add_counts(std::size_t lane, Counts& counts) const {
        for (std::size_t block = 0; block < lane_visits_.size(); ++block)
            for (const auto& [kind, number] : program_.blocks[block].costs)
                counts[static_cast<std::size_t>(kind)] += std::uint64_t{lane_visits_[block][lane]} * number;
    }

  private:
    void execute_at(std::uint32_t at) {
        if (regrouping_ && regrouping_->takes_over(at)) return fit(at);
        const Operation& operation = program_.operations[at];
        execute(operation);
        fit(at);
        if (regrouping_) regrouping_->after(at);
        if (options_.errors != Errors::none)
            if (const Row& row = row_of(operation); row.liberties.largest_error != nullptr)
                add_largest_error(row, operation, program_.infos[at].result.count, registers_,
                                  options_.errors == Errors::largest_up);
        if (!options_.is_half || !program_.infos[at].is_relaxed) return;
        if (row_of(operation).code == kScatter)
            make_half_at_addresses(at, program_.infos[at].result);
        else
            make_half(at, program_.infos[at].result);
    }

    [[nodiscard]] T half_of(T number, std::uint32_t at, std::size_t lane) const {
        const SmallHalves small =
            small_halves(options_, program_.constants.size() + at, registers_.first_invocation + lane);
        return static_cast<T>(rounded_to_half(static_cast<float>(number), small));
    }

    void execute(const Operation& operation) { rows_[operation.row](operation, registers_); }

    void make_half(std::uint32_t at, const Slice& result) {
        if (result.scalar != Scalar::float32) return;
        T* const row = registers_.floats(result.slot);
        for (std::size_t i = 0; i < result.count * kLanes; ++i)
            if (registers_.is_active(i % kLanes)) row[i] = half_of(row[i], at, i % kLanes);
    }

    /// Of a store whose place each lane computes.
    void make_half_at_addresses(std::uint32_t at, const Slice& variable) {
        if (variable.scalar != Scalar::float32) return;
        const Operation& store = program_.operations[at];
        for (std::uint32_t component = 0; component < store.count; ++component)
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if (!registers_.is_active(lane)) continue;
                const auto offset = static_cast<std::uint32_t>(registers_.ints(store.operands[1])[lane]);
                T& cell = registers_.floats(store.result + offset + component)[lane];
                cell = half_of(cell, at, lane);
            }
    }

    /// Brings the operation's result to the width of its type, where rows are wider than that.
    void fit(std::uint32_t at) {
        if (!program_.has_narrow && !options_.is_single) return;
        const Row& row = row_of(program_.operations[at]);
        // What is only passed on fits already.
        if (row.kind == Kind::move || row.kind == Kind::load || row.kind == Kind::store ||
            row.kind == Kind::select)
            return;
        Slice result = program_.infos[at].result;
        // The second half of what frexp() gives are integers.
        if (row.code == kExtended + GLSLstd450FrexpStruct) result.count = program_.operations[at].count;
        if (result.scalar == Scalar::float16 && (sizeof(T) == 4 || options_.is_single)) {
            result.scalar = Scalar::float32;
            return make_half(at, result);
        }
        if (result.scalar == Scalar::float32 && options_.is_single)
            for (T* cell = registers_.floats(result.slot);
                 cell < registers_.floats(result.slot + result.count); ++cell)
                *cell = static_cast<T>(static_cast<float>(*cell));
        if (is_narrow(result.scalar) && !is_float(result.scalar))
            for (Int<T>* cell = registers_.ints(result.slot);
                 cell < registers_.ints(result.slot + result.count); ++cell)
                *cell = wrapped(*cell, result.scalar);
    }

    void run_observed(const Block& block) {
        const LaneMask lanes = registers_.active() & registers_.callers_lanes;
        for (std::uint32_t at = block.first; at < block.first + block.count; ++at) {
            const Operation& operation = program_.operations[at];
            const Step<T> step{program_,
                               at,
                               lanes,
                               registers_.first_invocation,
                               registers_.floats(0),
                               discarded_,
                               options_.is_half && program_.infos[at].is_relaxed};
            const bool is_shown = observer_ != nullptr && lanes != 0 && !step.row().is_bookkeeping;
            if (is_shown) {
                observer_->before(step);
                observe_indices(step, operation, lanes);
            }
            execute_at(at);
            if (options_.rounded_in != nullptr) round_result(at);
            if (is_shown)
                observer_->after(step);
            else if (observer_ != nullptr && step.row().code == kCopy)
                observer_->copied(operation, registers_.active());
        }
    }

    /// Where the operation's result is to be a float's, makes it one.
    void round_result(std::uint32_t operation) {
        const std::int64_t lane =
            (*options_.rounded_in)[operation] - static_cast<std::int64_t>(registers_.first_invocation);
        const Slice& result = program_.infos[operation].result;
        if (lane < 0 || lane >= static_cast<std::int64_t>(kLanes) || result.scalar != Scalar::float32) return;
        if (!registers_.is_active(static_cast<std::size_t>(lane))) return;
        for (std::uint32_t component = 0; component < result.count; ++component) {
            T& cell = registers_.floats(result.slot + component)[lane];
            cell = static_cast<T>(static_cast<float>(cell));
        }
    }

    /// Tells the observer of each dynamic index outside its extent.
    void observe_indices(const Step<T>& step, const Operation& operation, LaneMask lanes) {
        const auto check = [&](std::uint32_t slot, std::uint32_t extent, bool is_stated = true) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const std::int64_t index = to_signed(registers_.ints(slot)[lane]);
                if (has_lane(lanes, lane) && (index < 0 || (is_stated && index >= extent)))
                    observer_->clamped(step, lane, index, extent);
            }
        };
        const std::uint32_t* words = registers_.words(operation);
        const std::uint32_t code = row_of(operation).code;
        for (std::uint32_t at = 1; at < operation.extras && code == spv::OpAccessChain; at += 3)
            check(words[at], words[at + 1], !program_.unstated_extents.contains(operation.extra + at + 1));
        if (code == spv::OpVectorExtractDynamic) check(operation.operands[1], words[0]);
        if (code == spv::OpVectorInsertDynamic) check(operation.operands[2], words[0]);
    }

    void count_visit(std::uint32_t block) {
        const Int<T>* mask = registers_.mask_row();
        auto& visits = lane_visits_[block];
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            visits[lane] += static_cast<std::uint32_t>(mask[lane] & 1);
    }

    void run_copies(const Edge& edge) {
        for (std::uint32_t at = edge.first_copy; at < edge.first_copy + edge.copies; ++at) {
            rows_[program_.copies[at].row](program_.copies[at], registers_);
            if (regrouping_) regrouping_->copy(program_.copies[at]);
            if (observer_ != nullptr) observer_->copied(program_.copies[at], registers_.active());
        }
    }

    void leave(const Block& block) {
        switch (block.end) {
            case Block::End::jump:
                return take(program_.edges[block.edge]);
            case Block::End::branch:
                return leave_branch(block);
            case Block::End::select:
                return leave_switch(block);
            case Block::End::kill:
                discarded_ |= registers_.active();
                [[fallthrough]];
            case Block::End::finish:
                return go(Program::kEnd);
        }
    }

    /// The active lanes go on together.
    void take(const Edge& edge) {
        run_copies(edge);
        go(edge.target);
    }

    void go(std::uint32_t target) {
        if (target < earliest_ || waiting_ == 0) {
            current_ = target;
            return;
        }
        send(registers_.active(), Edge{target, 0, 0});
        pick_next();
    }

    /// These lanes take the edge, and wait at its end.
    void send(LaneMask lanes, const Edge& edge) {
        if (lanes == 0) return;
        registers_.set_active(lanes);
        run_copies(edge);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (has_lane(lanes, lane)) waiting_at_[lane] = edge.target;
        if (edge.target != Program::kEnd) waiting_ |= lanes;
    }

    [[nodiscard]] std::uint32_t earliest_waiting() const {
        std::uint32_t earliest = Program::kEnd;
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (has_lane(waiting_, lane)) earliest = std::min(earliest, waiting_at_[lane]);
        return earliest;
    }

    /// All lanes wait: those at the earliest block run.
    void pick_next() {
        current_ = earliest_waiting();
        const LaneMask chosen =
            waiting_ & lanes_where([&](std::size_t lane) { return waiting_at_[lane] == current_; });
        waiting_ &= ~chosen;
        earliest_ = earliest_waiting();
        registers_.set_active(chosen);
    }

    /// Of the active lanes.
    LaneMask lanes_where_true(std::uint32_t slot) {
        const Int<T>* condition = registers_.ints(slot);
        const Int<T>* mask = registers_.mask_row();
        // Mostly all lanes agree, which one pass over the row tells.
        Int<T> number = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) number += condition[lane] & mask[lane];
        if (number == 0) return 0;
        if (number == std::popcount(registers_.active())) return registers_.active();
        return lanes_where([&](std::size_t lane) { return (condition[lane] & mask[lane] & 1) != 0; });
    }

    void leave_branch(const Block& block) {
        const LaneMask active = registers_.active();
        const LaneMask taken = lanes_where_true(block.condition);
        const Edge& if_true = program_.edges[block.edge];
        const Edge& if_false = program_.edges[block.edge + 1];
        if (taken == active || taken == 0) return take(taken == 0 ? if_false : if_true);
        send(taken, if_true);
        send(active & ~taken, if_false);
        pick_next();
    }

    void leave_switch(const Block& block) {
        LaneMask left = registers_.active();
        const LaneMask active = left;
        const Int<T>* selector = registers_.ints(block.condition);
        for (std::uint32_t label = 0; label + 1 < block.edges && left != 0; ++label) {
            const std::uint32_t number = program_.words[block.labels + label];
            const LaneMask chosen =
                left & lanes_where([&](std::size_t lane) { return to_unsigned(selector[lane]) == number; });
            const Edge& edge = program_.edges[block.edge + label + 1];
            if (chosen == active) return take(edge);
            left &= ~chosen;
            send(chosen, edge);
        }
        send(left, program_.edges[block.edge]);
        pick_next();
    }

    const Program& program_;
    Registers<T>& registers_;
    const Options& options_;
    Observer<T>* observer_;
    std::vector<Execute<T>> rows_;
    std::optional<Regrouping<T>> regrouping_;                     ///< where sums are not computed as written
    std::vector<std::uint64_t> loop_visits_;                      ///< of each block that is a loop's head
    std::vector<std::array<std::uint32_t, kLanes>> lane_visits_;  ///< of each block, where counts are wanted
    std::array<std::uint32_t, kLanes> waiting_at_{};              ///< block of each lane that does not run
    LaneMask waiting_ = 0;
    std::uint32_t earliest_ = Program::kEnd;  ///< of the blocks that lanes wait at
    std::uint32_t current_ = 0;
    LaneMask discarded_ = 0;
};

}  // namespace gobo::evaluate
