#include "lab/evaluate/scheduler.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/evaluate/largest_errors.hpp"
#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// How the row runs on the machine of these options.
const Execution& execution_of(const Row& row, const Options& options) {
    const Liberties& other = row.liberties;
    const auto chosen = [&](const Execution& execution) -> const Execution& {
        return execution.in_float != nullptr ? execution : row.execution;
    };
    if (options.sums == Sums::fused && other.fused.in_float != nullptr) return other.fused;
    if (options.sums > Sums::fused && other.backwards.in_float != nullptr) return other.backwards;
    if (options.nans == NaNs::kept) return chosen(other.nan_kept);
    if (options.nans == NaNs::dropped) return chosen(other.nan_dropped);
    return row.execution;
}

}  // namespace

template <class T>
Scheduler<T>::Scheduler(const Program& program, Machine<T>& machine, const Options& options,
                        Observer<T>* observer)
    : program_(program), machine_(machine), options_(options), observer_(observer) {
    for (const Row& row : instruction_table()) rows_.push_back(execution_of(row, options).in<T>());
    if (options.sums != Sums::as_written) regrouping_.emplace(program, machine, options.sums);
    loop_visits_.resize(program.blocks.size());
    if (options.count) lane_visits_.resize(program.blocks.size());
}

template <class T>
std::optional<Diagnostic> Scheduler<T>::run() {
    std::fill(loop_visits_.begin(), loop_visits_.end(), 0);
    for (auto& visits : lane_visits_) visits.fill(0);
    if (regrouping_) regrouping_->begin();
    discarded_ = 0;
    waiting_ = 0;
    earliest_ = Program::kEnd;
    current_ = 0;
    machine_.set_active(kAllLanes);
    while (current_ != Program::kEnd) {
        const Block& block = program_.blocks[current_];
        if (block.is_loop && ++loop_visits_[current_] > options_.iteration_limit)
            return error_at(
                program_.places[block.place],
                fmt::format("the loop is not left after {} iterations", options_.iteration_limit));
        if (!lane_visits_.empty()) count_visit(current_);
        if (observer_ != nullptr || options_.rounded_in != nullptr)
            run_observed(block);
        else if (regrouping_)
            run_regrouped(block);
        else
            run_quickly(block);
        leave(block);
    }
    return std::nullopt;
}

template <class T>
void Scheduler<T>::run_quickly(const Block& block) {
    const Operation* operation = program_.quick.data() + block.quick_first;
    for (const Operation* end = operation + block.quick_count; operation != end; ++operation)
        execute(*operation);
}

template <class T>
void Scheduler<T>::run_regrouped(const Block& block) {
    for (std::uint32_t at = block.first; at < block.first + block.count; ++at) execute_at(at);
}

template <class T>
void Scheduler<T>::execute_at(std::uint32_t at) {
    if (regrouping_ && regrouping_->takes_over(at)) return;
    execute(program_.operations[at]);
    if (regrouping_) regrouping_->after(at);
}

template <class T>
void Scheduler<T>::execute(const Operation& operation) {
    rows_[operation.row](operation, machine_);
    if (options_.errors == Errors::none) return;
    const std::uint32_t code = instruction_table()[operation.row].code;
    if (has_largest_error(code))
        add_largest_error(code, operation, machine_, options_.errors == Errors::largest_up);
}

template <class T>
void Scheduler<T>::run_observed(const Block& block) {
    const LaneMask lanes = machine_.active() & machine_.real;
    for (std::uint32_t at = block.first; at < block.first + block.count; ++at) {
        const Operation& operation = program_.operations[at];
        const Step<T> step{program_, at, lanes, machine_.first_invocation, machine_.reals(0)};
        const bool is_shown = observer_ != nullptr && lanes != 0 && !step.name().empty();
        if (is_shown) {
            observer_->before(step);
            observe_indices(step, operation, lanes);
        }
        execute_at(at);
        if (options_.rounded_in != nullptr) round_result(at);
        if (is_shown) observer_->after(step);
    }
}

/// Where the operation's result is to be a float's, makes it one.
template <class T>
void Scheduler<T>::round_result(std::uint32_t operation) {
    const std::int64_t lane =
        (*options_.rounded_in)[operation] - static_cast<std::int64_t>(machine_.first_invocation);
    const Slice& result = program_.infos[operation].result;
    if (lane < 0 || lane >= static_cast<std::int64_t>(kLanes) || result.scalar != Scalar::real) return;
    if (!machine_.is_active(static_cast<std::size_t>(lane))) return;
    for (std::uint32_t component = 0; component < result.count; ++component) {
        T& cell = machine_.reals(result.slot + component)[lane];
        cell = static_cast<T>(static_cast<float>(cell));
    }
}

/// Tells the observer of each dynamic index outside its extent.
template <class T>
void Scheduler<T>::observe_indices(const Step<T>& step, const Operation& operation, LaneMask lanes) {
    const auto check = [&](std::uint32_t slot, std::uint32_t extent) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::int64_t index = to_signed(machine_.wholes(slot)[lane]);
            if ((lanes >> lane & 1U) != 0 && (index < 0 || index >= extent))
                observer_->clamped(step, lane, index, extent);
        }
    };
    const std::uint32_t* words = machine_.words(operation);
    switch (instruction_table()[operation.row].code) {
        case spv::OpAccessChain:
            for (std::uint32_t at = 1; at < operation.extras; at += 3) check(words[at], words[at + 1]);
            break;
        case spv::OpVectorExtractDynamic:
            check(operation.operands[1], words[0]);
            break;
        case spv::OpVectorInsertDynamic:
            check(operation.operands[2], words[0]);
            break;
        default:
            break;
    }
}

template <class T>
void Scheduler<T>::count_visit(std::uint32_t block) {
    const Whole<T>* mask = machine_.mask_row();
    auto& visits = lane_visits_[block];
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        visits[lane] += static_cast<std::uint32_t>(mask[lane] & 1);
}

template <class T>
void Scheduler<T>::add_counts(std::size_t lane, Counts& counts) const {
    for (std::size_t block = 0; block < lane_visits_.size(); ++block)
        for (const auto& [kind, number] : program_.blocks[block].costs)
            counts[static_cast<std::size_t>(kind)] += std::uint64_t{lane_visits_[block][lane]} * number;
}

template <class T>
void Scheduler<T>::run_copies(const Edge& edge) {
    for (std::uint32_t at = edge.first_copy; at < edge.first_copy + edge.copies; ++at) {
        rows_[program_.copies[at].row](program_.copies[at], machine_);
        if (regrouping_) regrouping_->keep(program_.copies[at]);
    }
}

template <class T>
void Scheduler<T>::leave(const Block& block) {
    switch (block.end) {
        case Block::End::jump:
            run_copies(program_.edges[block.edge]);
            return go(program_.edges[block.edge].target);
        case Block::End::branch:
            return leave_branch(block);
        case Block::End::select:
            return leave_switch(block);
        case Block::End::kill:
            discarded_ |= machine_.active();
            [[fallthrough]];
        case Block::End::finish:
            return go(Program::kEnd);
    }
}

/// The active lanes go on together.
template <class T>
void Scheduler<T>::go(std::uint32_t target) {
    if (target < earliest_ || waiting_ == 0) {
        current_ = target;
        return;
    }
    send(machine_.active(), Edge{target, 0, 0});
    pick_next();
}

/// These lanes take the edge, and wait at its end.
template <class T>
void Scheduler<T>::send(LaneMask lanes, const Edge& edge) {
    if (lanes == 0) return;
    machine_.set_active(lanes);
    run_copies(edge);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((lanes >> lane & 1U) != 0) waiting_at_[lane] = edge.target;
    if (edge.target != Program::kEnd) waiting_ |= lanes;
}

/// All lanes wait: those at the earliest block run.
template <class T>
void Scheduler<T>::pick_next() {
    current_ = Program::kEnd;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((waiting_ >> lane & 1U) != 0) current_ = std::min(current_, waiting_at_[lane]);
    LaneMask chosen = 0;
    earliest_ = Program::kEnd;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if ((waiting_ >> lane & 1U) == 0) continue;
        if (waiting_at_[lane] == current_)
            chosen |= LaneMask{1} << lane;
        else
            earliest_ = std::min(earliest_, waiting_at_[lane]);
    }
    waiting_ &= ~chosen;
    machine_.set_active(chosen);
}

/// Of the active lanes.
template <class T>
LaneMask Scheduler<T>::lanes_where_true(std::uint32_t slot) {
    const Whole<T>* condition = machine_.wholes(slot);
    const Whole<T>* mask = machine_.mask_row();
    // Mostly all lanes agree, which one pass over the row tells.
    Whole<T> number = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) number += condition[lane] & mask[lane];
    if (number == 0) return 0;
    if (number == std::popcount(machine_.active())) return machine_.active();
    LaneMask lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        lanes |= static_cast<LaneMask>(condition[lane] & mask[lane] & 1) << lane;
    return lanes;
}

template <class T>
void Scheduler<T>::leave_branch(const Block& block) {
    const LaneMask active = machine_.active();
    const LaneMask taken = lanes_where_true(block.condition);
    const Edge& if_true = program_.edges[block.edge];
    const Edge& if_false = program_.edges[block.edge + 1];
    if (taken == active || taken == 0) {
        const Edge& edge = taken == 0 ? if_false : if_true;
        run_copies(edge);
        return go(edge.target);
    }
    send(taken, if_true);
    send(active & ~taken, if_false);
    pick_next();
}

template <class T>
void Scheduler<T>::leave_switch(const Block& block) {
    LaneMask left = machine_.active();
    const LaneMask active = left;
    const Whole<T>* selector = machine_.wholes(block.condition);
    for (std::uint32_t label = 0; label + 1 < block.edges && left != 0; ++label) {
        LaneMask chosen = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if ((left >> lane & 1U) != 0 &&
                to_unsigned(selector[lane]) == program_.words[block.labels + label])
                chosen |= LaneMask{1} << lane;
        const Edge& edge = program_.edges[block.edge + label + 1];
        left &= ~chosen;
        if (chosen == active) {
            run_copies(edge);
            return go(edge.target);
        }
        send(chosen, edge);
    }
    send(left, program_.edges[block.edge]);
    pick_next();
}

template class Scheduler<float>;
template class Scheduler<double>;

}  // namespace gobo::evaluate
