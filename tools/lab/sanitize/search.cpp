#include "lab/sanitize/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gobo::sanitize {
namespace {

constexpr std::size_t kCopies = 16;        ///< of one point, in a row
constexpr std::size_t kFreshShare = 8;     ///< one portion in so many parts is from nowhere
constexpr std::uint64_t kPatience = 4096;  ///< copies without an advance, after which a goal counts half

/// How much there is to read in a number: nothing in 0, little in 1.
std::size_t length_of(double number) {
    if (number == 0) return 0;
    if (number == 1) return 1;
    return 1 + fmt::format("{}", static_cast<float>(number)).size();
}

std::size_t length_of(std::span<const double> numbers) {
    std::size_t length = 0;
    for (const double number : numbers) length += length_of(number);
    return length;
}

/// The number with so many significant digits.
double rounded(double number, int digits) {
    if (number == 0 || !std::isfinite(number)) return number;
    const double size = std::pow(10.0, std::floor(std::log10(std::abs(number))) - digits + 1);
    return std::round(number / size) * size;
}

class Shrinking {
  public:
    Shrinking(const evaluate::Program& program, const InputSpace& space, OutputBounds& bounds,
              const Finding& finding)
        : program_(program), space_(space), bounds_(bounds), wanted_(finding) {
        point_.numbers = space.numbers;
        point_.resize(1);
        for (const InputField& field : space.fields) take(field, finding.point);
    }

    Finding run() {
        std::optional<Finding> found = shown();
        if (!found) return wanted_;
        bool is_simpler = true;
        for (int round = 0; round < kMostRounds && is_simpler; ++round) {
            is_simpler = false;
            for (const InputField& field : space_.fields) is_simpler |= simplify(field, *found);
            is_simpler |= simplify_equal_numbers(*found);
        }
        found->stage = wanted_.stage;
        found->points = wanted_.points;
        return *found;
    }

  private:
    static constexpr int kMostRounds = 4;

    void take(const InputField& field, const Point& from) {
        for (const auto* values : {&from.inputs, &from.uniforms, &from.samplers})
            if (const auto given = values->find(field.name); given != values->end())
                std::copy_n(given->second.begin(), std::min(given->second.size(), field.components),
                            point_[0].begin() + static_cast<std::ptrdiff_t>(field.first));
    }

    /// What the point shows of what is wanted.
    std::optional<Finding> shown() {
        const std::vector<Interval> bounds = bounds_.at(point_);
        Result<std::vector<Finding>> found =
            find_traps(program_, invocations_of(space_, point_), wanted_.machine, bounds);
        if (!found) return std::nullopt;
        const auto same = std::find_if(found->begin(), found->end(), [&](const Finding& finding) {
            return finding.message == wanted_.message && finding.place == wanted_.place;
        });
        if (same == found->end()) return std::nullopt;
        return std::move(*same);
    }

    /// Takes the numbers if they are simpler than what stands there, and show the finding.
    bool attempt(const InputField& field, std::vector<double> numbers, Finding& found) {
        bring_into_domain(field, numbers);
        const std::span<double> place = point_[0].subspan(field.first, field.components);
        if (length_of(numbers) >= length_of(place)) return false;
        const std::vector<double> before(place.begin(), place.end());
        std::copy(numbers.begin(), numbers.end(), place.begin());
        if (std::optional<Finding> shown_now = shown()) {
            found = std::move(*shown_now);
            return true;
        }
        std::copy(before.begin(), before.end(), place.begin());
        return false;
    }

    /// What needs two inputs to be equal, or opposed, keeps them so: they change together.
    bool simplify_equal_numbers(Finding& found) {
        bool is_simpler = false;
        for (std::size_t i = 0; i < space_.numbers; ++i) {
            const double number = point_.values[i];
            for (const double simple : {1.0, 2.0, rounded(number, 1), rounded(number, 2), rounded(number, 3)})
                is_simpler |= attempt_everywhere(number, simple, found);
        }
        return is_simpler;
    }

    /// Takes `simple` for every `number`, and its opposite for the opposite.
    bool attempt_everywhere(double number, double simple, Finding& found) {
        const std::vector<double> before = point_.values;
        for (const InputField& field : space_.fields) {
            const std::span<double> numbers = point_[0].subspan(field.first, field.components);
            for (double& other : numbers)
                if (std::abs(other) == std::abs(number)) other = other == number ? simple : -simple;
            bring_into_domain(field, numbers);
        }
        if (length_of(point_.values) < length_of(before)) {
            if (std::optional<Finding> shown_now = shown()) {
                found = std::move(*shown_now);
                return true;
            }
        }
        point_.values = before;
        return false;
    }

    bool simplify(const InputField& field, Finding& found) {
        const std::size_t count = field.components;
        bool is_simpler = attempt(field, std::vector<double>(count, 0.0), found);
        is_simpler |= attempt(field, std::vector<double>(count, 1.0), found);
        const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
        if (count > 4 && rows * rows == count) {
            std::vector<double> identity(count);
            for (std::size_t i = 0; i < rows; ++i) identity[i * rows + i] = 1;
            is_simpler |= attempt(field, identity, found);
        }
        for (std::size_t c = 0; c < count; ++c) is_simpler |= simplify_component(field, c, found);
        return is_simpler;
    }

    bool simplify_component(const InputField& field, std::size_t component, Finding& found) {
        const std::span<const double> now = point_[0].subspan(field.first, field.components);
        const std::vector<double> start(now.begin(), now.end());
        const double number = start[component];
        std::vector<double> candidates = {0, 1, -1, number < 0 ? -2.0 : 2.0};
        for (int digits = 1; digits <= 6; ++digits) candidates.push_back(rounded(number, digits));
        for (const double candidate : candidates) {
            std::vector<double> changed = start;
            changed[component] = candidate;
            if (attempt(field, std::move(changed), found)) return true;
        }
        return false;
    }

    const evaluate::Program& program_;
    const InputSpace& space_;
    OutputBounds& bounds_;
    const Finding& wanted_;
    PointSet point_;
};

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

Signature signature_of(const Finding& finding) {
    return {finding.place.file, finding.place.line, finding.message};
}

StageSearch::StageSearch(const Family& family, const Key& key, StageKind kind, evaluate::Program program,
                         DepthPromise promise, std::vector<Machine> machines)
    : kind_(kind),
      program_(std::move(program)),
      space_(input_space_of(program_, family.domains)),
      bounds_(family, key, kind, program_, space_, promise),
      machines_(std::move(machines)) {}

Result<void> StageSearch::run(const PointSet& points) {
    const evaluate::Invocations invocations = invocations_of(space_, points);
    const std::vector<Interval> bounds = bounds_.at(points);
    std::map<Signature, Finding> all;
    for (const Machine machine : machines_) {
        if (guide_) guide_->begin_run();
        GOBO_TRY(auto found,
                 find_traps(program_, invocations, machine, bounds, guide_ ? &guide_->observer() : nullptr));
        if (guide_) guide_->learn(points);
        std::map<Signature, std::uint64_t> on_this_machine;
        for (Finding& finding : found) {
            on_this_machine[signature_of(finding)] += finding.points;
            finding.stage = kind_;
            all.try_emplace(signature_of(finding), std::move(finding));
        }
        // A point that traps on several machines is still one.
        for (const auto& [signature, count] : on_this_machine)
            all[signature].points = std::max(all[signature].points, count);
    }
    for (const auto& [signature, finding] : all) {
        const auto [known, is_new] = findings_.try_emplace(signature, finding);  // the first example is kept
        if (!is_new) known->second.points += finding.points;
    }
    points_ += points.count();
    return {};
}

Finding StageSearch::simplified(const Finding& finding) {
    return Shrinking(program_, space_, bounds_, finding).run();
}

}  // namespace gobo::sanitize
