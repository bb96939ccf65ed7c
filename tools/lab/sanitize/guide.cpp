#include "lab/sanitize/guide.hpp"

#include <algorithm>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Kind;
using Step = evaluate::Step<float>;

constexpr std::size_t kCopies = 16;        ///< of one point, in a row
constexpr std::size_t kFreshShare = 8;     ///< one portion in so many parts is from nowhere
constexpr std::uint64_t kPatience = 4096;  ///< copies without an advance, after which a goal counts half

/// Operations whose results can be much larger than their operands.
bool can_overflow(Kind kind) {
    return kind == Kind::mul || kind == Kind::div || kind == Kind::pow || kind == Kind::exp ||
           kind == Kind::dot || kind == Kind::matrix || kind == Kind::inverse_sqrt;
}

}  // namespace

Guide::Guide(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed)
    : space_(space), random_(seed), seed_(seed) {
    std::size_t goals = 0;
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        const bool may_overflow =
            can_overflow(row.kind) && evaluate::is_float(program.infos[at].result.scalar);
        watches_.push_back({rules_of(goal_rules(), row.code), may_overflow, goals});
        goals += watches_.back().rules.size() + (may_overflow ? 1 : 0);
    }
    goals_.resize(goals);
}

void Guide::after(const Step& step) {
    const Watch& watch = watches_[step.operation];
    std::size_t goal = watch.first_goal;
    for (const GoalRule& rule : watch.rules) measure(step, rule.measure, goals_[goal++]);
    if (watch.may_overflow) measure(step, &measure_overflow, goals_[goal]);
}

void Guide::measure(const Step& step, decltype(GoalRule::measure) lower, Goal& goal) const {
    if (goal.distance == 0) return;
    Distances distances;
    distances.fill(std::numeric_limits<float>::infinity());
    lower(step, distances);
    float nearest = std::numeric_limits<float>::infinity();
    for (const float distance : distances) nearest = distance < nearest ? distance : nearest;
    if (nearest >= goal.distance) return;
    for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
        if ((step.lanes >> lane & 1U) == 0 || !(distances[lane] < goal.distance)) continue;
        goal.distance = distances[lane];
        goal.run = run_;
        goal.invocation = step.first_invocation + lane;
    }
}

void Guide::learn(const PointSet& points) {
    for (std::size_t index = 0; index < goals_.size(); ++index) {
        Goal& goal = goals_[index];
        if (goal.run != run_) continue;
        if (goal.point.empty()) known_.push_back(index);
        const std::size_t index_of_point = goal.invocation / space_.pixels;
        const std::span<const double> point = points[index_of_point];
        goal.point.assign(point.begin(), point.end());
        goal.failures = 0;
        if (index_of_point < last_changed_.size()) goal.changed = last_changed_[index_of_point];
    }
    ++run_;
}

PointSet Guide::next(std::size_t count) {
    const std::size_t fresh = known_.empty() ? count : count / kFreshShare;
    PointSet points = hard_points(space_, count, ++seed_);
    last_changed_.assign(count, 0);
    if (space_.numbers == 0) return points;
    for (std::size_t first = fresh; first < count; first += kCopies) {
        Goal& goal = goals_[pick_goal()];
        for (std::size_t i = first; i < std::min(first + kCopies, count); ++i) {
            std::copy(goal.point.begin(), goal.point.end(), points[i].begin());
            last_changed_[i] = random_.one_in(2) ? goal.changed : random_.index(space_.numbers);
            change(space_, points[i], last_changed_[i], random_);
            const std::size_t more = random_.one_in(4) ? 1 + random_.index(3) : 0;
            change_any(space_, points[i], more, random_);
            ++goal.failures;
        }
    }
    return points;
}

/// Of two at random, the one that promises more.
std::size_t Guide::pick_goal() {
    const auto promise = [&](std::size_t goal) {
        const double share = goals_[goal].distance == 0 ? 0.25 : 1;
        return share / (1 + static_cast<double>(goals_[goal].failures / kPatience));
    };
    const std::size_t one = random_.pick(known_);
    const std::size_t other = random_.pick(known_);
    const double draw = promise(one) * random_.unit();
    return draw > promise(other) * random_.unit() ? one : other;
}

}  // namespace gobo::sanitize
