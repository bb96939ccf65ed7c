// A guided search: points made of what earlier ones came near to.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lab/sanitize/hard_points.hpp"
#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {

/// Watches the runs of one program, measures how near they come to each goal, and remembers the point that
/// came nearest. A fresh portion holds changed copies of these, most for goals that are not reached and whose
/// copies still advance, and some points from nowhere.
class Guide final : public evaluate::Observer<float> {
  public:
    /// `space` must outlive it.
    Guide(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed);

    void after(const evaluate::Step<float>& step) override;
    /// To be called when a run is over, with its points.
    void learn(const PointSet& points);
    [[nodiscard]] PointSet next(std::size_t count);

  private:
    /// What an operation is measured for: goals of the rules, then the one of its size.
    struct Watch {
        std::span<const GoalRule> rules;
        bool may_overflow = false;
        std::size_t first_goal = 0;
    };
    struct Goal {
        float distance = std::numeric_limits<float>::infinity();  ///< the least so far; 0 once it is reached
        std::uint64_t run = 0;                                    ///< in which that was
        std::size_t invocation = 0;                               ///< of that run
        std::vector<double> point;                                ///< there; empty where none came near
        std::size_t changed = 0;     ///< the number whose change brought it there
        std::uint64_t failures = 0;  ///< copies since then
    };
    void measure(const evaluate::Step<float>& step, decltype(GoalRule::measure) lower, Goal& goal) const;
    [[nodiscard]] std::size_t pick_goal();

    const InputSpace& space_;
    Random random_;
    std::vector<Watch> watches_;  ///< of each operation
    std::vector<Goal> goals_;
    std::vector<std::size_t> known_;         ///< goals with a point
    std::vector<std::size_t> last_changed_;  ///< of each point of the last portion
    std::uint64_t run_ = 1;
    std::uint64_t seed_;
};

}  // namespace gobo::sanitize
