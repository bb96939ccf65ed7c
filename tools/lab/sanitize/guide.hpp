// Chooses points by what earlier ones reached.
#pragma once

#include <vector>

#include "lab/sanitize/hard_inputs.hpp"
#include "lab/sanitize/point_changer.hpp"
#include "lab/sanitize/reach_observer.hpp"

namespace gobo::sanitize {

/// Remembers for each goal the point that came nearest to it. A fresh portion holds changed copies of these,
/// most for goals that are not reached and whose copies still advance, and some points from nowhere.
class Guide {
  public:
    Guide(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed);

    /// To be given to the run of the points that learn() is told of.
    [[nodiscard]] ReachObserver& observer() { return observer_; }
    void begin_run() { observer_.begin_run(); }
    void learn(const PointSet& points);

    [[nodiscard]] PointSet next(std::size_t count);

  private:
    struct Goal {
        std::vector<double> point;   ///< that came nearest; empty where none came near
        std::size_t changed = 0;     ///< the number whose change brought it there
        std::uint64_t failures = 0;  ///< copies since then
    };
    [[nodiscard]] std::size_t pick_goal();

    const InputSpace& space_;
    ReachObserver observer_;
    Random random_;
    PointChanger changer_;
    std::vector<Goal> goals_;
    std::vector<std::size_t> known_;         ///< goals with a point
    std::vector<std::size_t> last_changed_;  ///< of each point of the last portion
    std::uint64_t seed_;
};

}  // namespace gobo::sanitize
