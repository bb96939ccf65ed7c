#include "lab/sanitize/guide.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::sanitize {
namespace {

constexpr std::size_t kCopies = 16;        ///< of one point, in a row
constexpr std::size_t kFreshShare = 8;     ///< one portion in so many parts is from nowhere
constexpr std::uint64_t kPatience = 4096;  ///< copies without an advance, after which a goal counts half

}  // namespace

Guide::Guide(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed)
    : space_(space),
      observer_(program),
      random_(seed),
      changer_(space),
      goals_(observer_.reaches().size()),
      seed_(seed) {}

void Guide::learn(const PointSet& points) {
    for (const std::size_t index : observer_.advanced()) {
        Goal& goal = goals_[index];
        if (goal.point.empty()) known_.push_back(index);
        const std::size_t invocation = observer_.reaches()[index].invocation;
        const std::span<const double> point = points[invocation];
        goal.point.assign(point.begin(), point.end());
        goal.failures = 0;
        if (invocation < last_changed_.size()) goal.changed = last_changed_[invocation];
    }
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
            const std::size_t number = random_.one_in(2) ? goal.changed : random_.index(space_.numbers);
            last_changed_[i] = changer_.change(points[i], number, random_);
            for (std::size_t more = random_.one_in(4) ? 1 + random_.index(3) : 0; more > 0; --more)
                (void)changer_.change(points[i], random_.index(space_.numbers), random_);
            ++goal.failures;
        }
    }
    return points;
}

/// Of two at random, the one that promises more.
std::size_t Guide::pick_goal() {
    const auto promise = [&](std::size_t goal) {
        const double share = observer_.reaches()[goal].is_reached() ? 0.25 : 1;
        return share / (1 + static_cast<double>(goals_[goal].failures / kPatience));
    };
    const std::size_t one = random_.pick(known_);
    const std::size_t other = random_.pick(known_);
    return promise(one) * random_.unit() > promise(other) * random_.unit() ? one : other;
}

}  // namespace gobo::sanitize
