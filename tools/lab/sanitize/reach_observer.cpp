#include "lab/sanitize/reach_observer.hpp"

#include <algorithm>
#include <limits>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using evaluate::kLanes;
using Step = evaluate::Step<float>;

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Operations whose results can be much larger than their operands.
bool can_overflow(Kind kind) {
    return kind == Kind::mul || kind == Kind::div || kind == Kind::pow || kind == Kind::exp ||
           kind == Kind::dot || kind == Kind::matrix || kind == Kind::inverse_sqrt;
}

}  // namespace

ReachObserver::ReachObserver(const evaluate::Program& program) {
    const auto rules = goal_rules();
    std::size_t goals = 0;
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        const auto is_other = [&](const GoalRule& rule) { return rule.code != row.code; };
        const auto first = std::find_if_not(rules.begin(), rules.end(), is_other);
        const auto last = std::find_if(first, rules.end(), is_other);
        Watch watch;
        watch.first_rule = static_cast<std::uint32_t>(first - rules.begin());
        watch.rules = static_cast<std::uint32_t>(last - first);
        watch.may_overflow =
            can_overflow(row.kind) && program.infos[at].result.scalar == evaluate::Scalar::float32;
        watch.first_goal = goals;
        goals += watch.rules + (watch.may_overflow ? 1 : 0);
        watches_.push_back(watch);
    }
    reaches_.resize(goals);
}

std::vector<std::size_t> ReachObserver::advanced() const {
    std::vector<std::size_t> goals;
    for (std::size_t goal = 0; goal < reaches_.size(); ++goal)
        if (reaches_[goal].run == run_) goals.push_back(goal);
    return goals;
}

void ReachObserver::after(const Step& step) {
    const Watch& watch = watches_[step.operation];
    std::size_t goal = watch.first_goal;
    Distances distances;
    for (const GoalRule& rule : goal_rules().subspan(watch.first_rule, watch.rules)) {
        Reach& reach = reaches_[goal++];
        if (reach.is_reached()) continue;
        distances.fill(kFar);
        rule.measure(step, distances);
        keep_nearest(step, distances, reach);
    }
    if (watch.may_overflow && !reaches_[goal].is_reached()) {
        distances.fill(kFar);
        measure_overflow(step, distances);
        keep_nearest(step, distances, reaches_[goal]);
    }
}

void ReachObserver::keep_nearest(const Step& step, const Distances& distances, Reach& reach) const {
    float nearest = kFar;
    for (const float distance : distances) nearest = distance < nearest ? distance : nearest;
    if (nearest >= reach.distance) return;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((step.lanes >> lane & 1U) != 0 && distances[lane] < reach.distance)
            reach = {distances[lane], run_, step.first_invocation + lane};
}

}  // namespace gobo::sanitize
