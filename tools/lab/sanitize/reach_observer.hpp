// Measures how near a run comes to each goal of a stage.
#pragma once

#include <limits>
#include <vector>

#include "lab/sanitize/goals.hpp"

namespace gobo::sanitize {

/// The nearest that anything came to a goal so far.
struct Reach {
    float distance = std::numeric_limits<float>::infinity();
    std::uint64_t run = 0;       ///< in which that was
    std::size_t invocation = 0;  ///< of that run

    [[nodiscard]] bool is_reached() const { return distance == 0; }
};

/// To be used for run after run of the same program.
class ReachObserver final : public evaluate::Observer<float> {
  public:
    explicit ReachObserver(const evaluate::Program& program);

    void begin_run() { ++run_; }
    void after(const evaluate::Step<float>& step) override;

    /// Of each goal.
    [[nodiscard]] const std::vector<Reach>& reaches() const { return reaches_; }
    /// Goals that the current run came nearer to than any before.
    [[nodiscard]] std::vector<std::size_t> advanced() const;

  private:
    /// What an operation is measured for: goals of the rules, then the one of its size.
    struct Watch {
        std::uint32_t first_rule = 0;
        std::uint32_t rules = 0;
        bool may_overflow = false;
        std::size_t first_goal = 0;
    };
    void keep_nearest(const evaluate::Step<float>& step, const Distances& distances, Reach& reach) const;

    std::vector<Watch> watches_;  ///< of each operation
    std::vector<Reach> reaches_;
    std::uint64_t run_ = 0;
};

}  // namespace gobo::sanitize
