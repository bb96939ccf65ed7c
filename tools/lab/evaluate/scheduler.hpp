// Runs the blocks of a program for the lanes of one batch. Internal to evaluation.
#pragma once

#include <array>
#include <bit>
#include <optional>
#include <vector>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/machine.hpp"
#include "lab/evaluate/regrouping.hpp"

namespace gobo::evaluate {

/// Lanes go through blocks together as long as they agree. Where they part, those at the earliest block run
/// first; the order of blocks (see structured_order()) makes them meet again where their ways join.
template <class T>
class Scheduler {
  public:
    Scheduler(const Program& program, Machine<T>& machine, const Options& options, Observer<T>* observer);

    /// Runs all lanes from the first block to the end. An endless loop is an error at its place.
    [[nodiscard]] std::optional<Diagnostic> run();
    [[nodiscard]] LaneMask discarded() const { return discarded_; }
    /// Adds what the lane executed in the last run.
    void add_counts(std::size_t lane, Counts& counts) const;

  private:
    void run_quickly(const Block& block);
    void run_regrouped(const Block& block);
    void execute(const Operation& operation);
    void execute_at(std::uint32_t at);
    void run_observed(const Block& block);
    void round_result(std::uint32_t operation);
    void observe_indices(const Step<T>& step, const Operation& operation, LaneMask lanes);
    void count_visit(std::uint32_t block);
    void run_copies(const Edge& edge);
    void leave(const Block& block);
    void leave_branch(const Block& block);
    void leave_switch(const Block& block);
    void go(std::uint32_t target);
    void send(LaneMask lanes, const Edge& edge);
    void pick_next();
    [[nodiscard]] LaneMask lanes_where_true(std::uint32_t slot);

    const Program& program_;
    Machine<T>& machine_;
    const Options& options_;
    Observer<T>* observer_;
    std::vector<Execute<T>> rows_;
    std::optional<Regrouping<T>> regrouping_;  ///< of machines that do not compute sums as written
    std::vector<std::uint64_t> loop_visits_;   ///< of each block that is a loop's head
    std::vector<std::array<std::uint32_t, kLanes>> lane_visits_;  ///< of each block, where counts are wanted
    std::array<std::uint32_t, kLanes> waiting_at_{};              ///< block of each lane that does not run
    LaneMask waiting_ = 0;
    std::uint32_t earliest_ = Program::kEnd;  ///< of the blocks that lanes wait at
    std::uint32_t current_ = 0;
    LaneMask discarded_ = 0;
};

extern template class Scheduler<float>;
extern template class Scheduler<double>;

}  // namespace gobo::evaluate
