#include "family/key_space.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/condition_pool.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

using Id = ConditionPool::Id;
using Comparison = Expression::Comparison;

/// What every key must meet, and which rule says so.
struct Demand {
    Id condition = ConditionPool::always;
    const Rule* rule = nullptr;  ///< nullptr: a limit of the selection
    std::vector<int> features;   ///< that it looks at
    std::size_t first = 0;       ///< the level of the first of them
    std::size_t last = 0;        ///< and of the last
};

/// Moves the features of a group close together: each to the middle of its groups' middles, again and again
/// (Aloul, Markov, Sakallah: FORCE, GLSVLSI 2003). Features that may have one value only go to the front,
/// where they cost nothing.
std::vector<int> ordered(std::vector<int> order, const std::vector<char>& is_fixed,
                         const std::vector<std::vector<int>>& groups) {
    constexpr int rounds = 20;
    std::vector<double> position(order.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<double>(i);
        std::vector<double> pulled(order.size(), 0), pulls(order.size(), 0);
        for (const std::vector<int>& group : groups) {
            double middle = 0;
            for (const int feature : group) middle += position[feature] / static_cast<double>(group.size());
            for (const int feature : group) {
                pulled[feature] += middle;
                ++pulls[feature];
            }
        }
        for (std::size_t i = 0; i < order.size(); ++i)
            if (pulls[i] > 0) position[i] = pulled[i] / pulls[i];
        const auto place = [&](int feature) { return position[feature]; };
        if (std::ranges::is_sorted(order, {}, place)) break;  // every further round would begin alike
        std::ranges::stable_sort(order, {}, place);
    }
    std::stable_partition(order.begin(), order.end(), [&](int feature) { return is_fixed[feature] != 0; });
    return order;
}

struct HashOfNumbers {
    std::size_t operator()(const std::vector<int>& numbers) const { return hash_of(numbers, numbers.size()); }
};
using NumberedLists = std::unordered_map<std::vector<int>, int, HashOfNumbers>;

/// What is left of the demands that are open at a level, in their order: a node before merging.
using State = std::vector<Id>;
using States = NumberedLists;

/// Names the rules that tell most of a level's states apart.
tl::unexpected<Diagnostics> too_large(const Family& family, const std::vector<const Demand*>& open,
                                      const States& states) {
    std::map<const Rule*, int> kinds;
    for (std::size_t i = 0; i < open.size(); ++i) {
        std::set<Id> left;
        for (const auto& [state, node] : states) left.insert(state[i]);
        kinds[open[i]->rule] = std::max(kinds[open[i]->rule], static_cast<int>(left.size()));
    }
    std::vector<std::tuple<int, int, const Rule*>> rules;  // those with most kinds first, then by line
    for (const auto& [rule, count] : kinds)
        rules.emplace_back(-count, rule == nullptr ? 0 : rule->place.line, rule);
    std::ranges::sort(rules);
    std::vector<std::string> names;
    for (const auto& [count, line, rule] : rules)
        names.push_back(rule == nullptr ? "the --where" : fmt::format("{}:{}", rule->place.file, line));
    if (names.empty())
        return fail(Fault::input,
                    fmt::format("family '{}' has too many features and values to count or cover its keys",
                                family.name),
                    "give it fewer features, or its counts smaller ranges");
    constexpr std::size_t most_named = 3;
    const std::size_t named = std::min(names.size(), most_named);
    const Rule* const first = std::get<const Rule*>(rules.front());
    return fail(
        first == nullptr ? Place() : first->place, {},
        fmt::format("the conditions of family '{}' tie too many values together to count or cover its keys",
                    family.name),
        fmt::format("simplify {}{}, or vary fewer features with --over",
                    fmt::join(std::span(names).first(named), ", "),
                    named < names.size() ? fmt::format(" and {} more", names.size() - named) : ""));
}

}  // namespace

/// Builds the diagram of one family level by level.
class KeySpace::Builder {
  public:
    Builder(const Family& family, std::string_view dialect, const KeySpaceLimits& limits)
        : family_(family), pool_(family.features) {
        for (const Feature& feature : family.features) allowed_.emplace_back(feature.values.size(), 1);
        for (const Rule& rule : family.rules) {
            if (!applies_in(rule, dialect)) continue;
            const Expression unless = negated(rule.when);
            if (rule.kind == Rule::Kind::forbid) demand(unless, ConditionPool::never, &rule);
            // What a default rule asks is already so.
            for (const int feature : rule.defaults)
                demand(unless, pool_.compare({feature}, Comparison::equal, 0), &rule);
        }
        for (const Expression& condition : limits.where) demand(condition, ConditionPool::never, nullptr);
        for (int i = 0; i < std::ssize(family.features); ++i) {
            const Feature& feature = family.features[i];
            if (!limits.over.empty() && std::ranges::find(limits.over, i) == limits.over.end())
                std::fill(allowed_[i].begin() + 1, allowed_[i].end(), 0);
            if (!limits.excluded)
                for (const std::string& value : feature.excluded)
                    allowed_[i][feature.index_of(value).value()] = 0;
        }
        for (const std::vector<char>& values : allowed_)
            is_fixed_.push_back(std::ranges::count(values, 1) <= 1 ? 1 : 0);
        for (std::vector<int>& group : groups_)
            std::erase_if(group, [&](int feature) { return is_fixed_[feature] != 0; });
        std::erase_if(groups_, [](const std::vector<int>& group) { return group.size() < 2; });
    }

    /// How small a diagram is depends on the order of its levels, and no rule tells a good one: of several,
    /// the first that needs few nodes is taken, then the first that needs not too many.
    Result<KeySpace> build() {
        constexpr int orders = 8;
        std::vector<int> natural(family_.features.size());
        std::iota(natural.begin(), natural.end(), 0);
        for (const std::size_t fraction : {32U, 8U}) {
            std::mt19937 random(1);
            std::vector<int> order = natural;
            for (int i = 0; i < orders; ++i) {
                if (Result<KeySpace> space = build(order, fraction)) return space;
                for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
            }
        }
        return build(natural, 1);
    }

  private:
    /// That the expression, or else `otherwise`, hold. In small parts: `a && b` is demanded as a and as b, so
    /// that no part is open for longer than its own features ask.
    void demand(const Expression& expression, Id otherwise, const Rule* rule) {
        if (expression.kind == Expression::Kind::conjunction) {
            for (const Expression& part : expression.parts) demand(part, otherwise, rule);
            return;
        }
        const Id condition = pool_.disjoin({pool_.add(expression), otherwise});
        is_empty_ = is_empty_ || condition == ConditionPool::never;
        const auto is_it = [&](const Demand& known) { return known.condition == condition; };
        if (std::ranges::any_of(demands_, is_it)) return;
        const std::size_t own = groups_.size();
        pool_.collect(condition, groups_);
        if (groups_[own].size() > 1) {
            demands_.push_back({condition, rule, groups_[own]});
            return;
        }
        for (const int feature : groups_[own])  // one alone: what it may be is known at once
            for (int value = 0; value < std::ssize(allowed_[feature]); ++value)
                if (pool_.assign(condition, feature, value) == ConditionPool::never)
                    allowed_[feature][value] = 0;
    }

    /// Errors where it takes more than the fraction of kMostNodes and kMostBranches.
    Result<KeySpace> build(const std::vector<int>& start, std::size_t fraction) {
        KeySpace space;
        space.feature_at_ = ordered(start, is_fixed_, groups_);
        std::vector<std::size_t> level_of(start.size());
        for (std::size_t level = 0; level < start.size(); ++level) level_of[space.feature_at_[level]] = level;
        for (const std::vector<char>& values : allowed_) space.value_counts_.push_back(values.size());
        for (Demand& demand : demands_) {
            const auto [first, last] =
                std::ranges::minmax(demand.features, {}, [&](int feature) { return level_of[feature]; });
            demand.first = level_of[first];
            demand.last = level_of[last];
        }
        std::vector<const Demand*> open;
        States states;
        if (!is_empty_) states.emplace(State{}, 0);
        const std::size_t known_conditions = pool_.size();
        std::size_t nodes = 0, branches = 0;
        for (std::size_t level = 0; level < start.size(); ++level) {
            nodes += states.size();
            branches += states.size() * space.value_counts_[space.feature_at_[level]];
            if (nodes + pool_.size() - known_conditions > kMostNodes / fraction ||
                branches > kMostBranches / fraction)
                return too_large(family_, open, states);
            space.node_counts_.push_back(states.size());
            states = follow(space, level, open, states);
            std::erase_if(open, [&](const Demand* demand) { return demand->last <= level; });
        }
        space.node_counts_.push_back(states.size());
        space.merge_equal_nodes();
        space.find_previous();
        return space;
    }

    /// The states of the next level; adds the level's branches, and to `open` the demands that begin here.
    States follow(KeySpace& space, std::size_t level, std::vector<const Demand*>& open,
                  const States& states) {
        const int feature = space.feature_at_[level];
        const std::vector<char>& allowed = allowed_[feature];
        const std::size_t before = open.size();
        for (const Demand& demand : demands_)
            if (demand.first == level) open.push_back(&demand);
        std::vector<int>& branches = space.branches_.emplace_back(states.size() * allowed.size(), dead);
        States following;
        State next;
        for (const auto& [left, node] : states) {
            State state = left;
            for (std::size_t i = before; i < open.size(); ++i) state.push_back(open[i]->condition);
            for (std::size_t value = 0; value < allowed.size(); ++value) {
                bool is_dead = allowed[value] == 0;
                next.clear();
                for (std::size_t i = 0; i < open.size() && !is_dead; ++i) {
                    const Id rest = pool_.assign(state[i], feature, static_cast<int>(value));
                    is_dead = rest == ConditionPool::never;
                    if (open[i]->last > level) next.push_back(rest);
                }
                if (is_dead) continue;
                branches[node * allowed.size() + value] =
                    following.try_emplace(next, static_cast<int>(following.size())).first->second;
            }
        }
        return following;
    }

    const Family& family_;
    ConditionPool pool_;
    std::vector<Demand> demands_;             ///< on several features each
    std::vector<std::vector<char>> allowed_;  ///< per feature and value: by the demands on it alone
    std::vector<char> is_fixed_;              ///< per feature: it may have one value only
    std::vector<std::vector<int>> groups_;  ///< features that conditions, or parts of them, look at together
    bool is_empty_ = false;
};

Result<KeySpace> KeySpace::make(const Family& family, std::string_view dialect,
                                const KeySpaceLimits& limits) {
    return Builder(family, dialect, limits).build();
}

/// From the end up: nodes that lead to the same become one, and those that lead nowhere none.
void KeySpace::merge_equal_nodes() {
    std::vector<int> merged(node_counts_.back(), 0);  // of the level below: each node's new number, or dead
    for (std::size_t level = feature_count(); level-- > 0;) {
        const std::size_t values = value_counts_[feature_at_[level]];
        NumberedLists known;
        std::vector<int> kept, numbers;
        for (std::size_t node = 0; node < node_counts_[level]; ++node) {
            std::vector<int> row;
            for (const int below : next(level, node)) row.push_back(below == dead ? dead : merged[below]);
            if (std::ranges::count(row, dead) == std::ssize(row)) {
                numbers.push_back(dead);
                continue;
            }
            const auto [same, is_new] = known.try_emplace(row, static_cast<int>(known.size()));
            numbers.push_back(same->second);
            if (is_new) kept.insert(kept.end(), row.begin(), row.end());
        }
        merged = std::move(numbers);
        branches_[level] = std::move(kept);
        node_counts_[level] = branches_[level].size() / values;
    }
}

void KeySpace::find_previous() {
    for (std::size_t level = 0; level < feature_count(); ++level) {
        std::vector<std::vector<int>> found(node_counts_[level + 1]);
        for (std::size_t node = 0; node < node_counts_[level]; ++node)
            for (const int below : next(level, node))
                if (below != dead && (found[below].empty() || found[below].back() != static_cast<int>(node)))
                    found[below].push_back(static_cast<int>(node));
        std::vector<int>& all = previous_.emplace_back();
        std::vector<std::size_t>& starts = previous_starts_.emplace_back(1, 0);
        for (const std::vector<int>& nodes : found) {
            all.insert(all.end(), nodes.begin(), nodes.end());
            starts.push_back(all.size());
        }
    }
}

WholeNumber KeySpace::count() const {
    std::vector<WholeNumber> below(node_counts_.back(), 1);
    for (std::size_t level = feature_count(); level-- > 0;) {
        std::vector<WholeNumber> here(node_counts_[level]);
        for (std::size_t node = 0; node < here.size(); ++node)
            for (const int target : next(level, node))
                if (target != dead) here[node] += below[target];
        below = std::move(here);
    }
    return below.empty() ? 0 : below.front();
}

std::vector<Key> KeySpace::keys() const {
    std::vector<Key> found;
    if (node_counts_.front() == 0) return found;
    Key key(feature_count(), -1);
    std::vector<int> nodes(feature_count() + 1, 0);  // per level: where the key leads
    // A family may have more features than the stack has room for calls: level after level in a loop.
    for (std::size_t level = 0;;) {
        if (level == feature_count()) {
            found.push_back(key);
            if (level-- == 0) break;
            continue;
        }
        int& value = key[feature_at_[level]];
        const std::span<const int> targets = next(level, nodes[level]);
        do ++value;
        while (value < std::ssize(targets) && targets[value] == dead);
        if (value < std::ssize(targets)) {
            nodes[++level] = targets[value];
            continue;
        }
        value = -1;
        if (level-- == 0) break;
    }
    std::sort(found.begin(), found.end());
    return found;
}

OpenPaths::OpenPaths(const KeySpace& space)
    : space_(&space), levels_(space.feature_count()), decided_(space.feature_count(), -1) {
    for (std::size_t level = 0; level < levels_.size(); ++level) levels_[space.feature_at(level)] = level;
    for (std::size_t level = 0; level <= levels_.size(); ++level) {
        is_open_.emplace_back(space.node_count(level), 1);
        open_.emplace_back(space.node_count(level));
        std::iota(open_.back().begin(), open_.back().end(), 0);
    }
}

std::vector<char> OpenPaths::allowed(std::size_t feature) const {
    const std::size_t level = levels_[feature];
    std::vector<char> result(space_->value_count(feature), 0);
    std::vector<std::size_t> missing(result.size());
    std::iota(missing.begin(), missing.end(), 0);
    for (const int node : open_[level]) {
        if (missing.empty()) break;
        const std::span<const int> next = space_->next(level, node);
        std::erase_if(missing, [&](std::size_t value) {
            const bool is_allowed = next[value] != KeySpace::dead && is_open_[level + 1][next[value]] != 0;
            if (is_allowed) result[value] = 1;
            return is_allowed;
        });
    }
    return result;
}

bool OpenPaths::leads_on(std::size_t level, int node) const {
    const std::span<const int> next = space_->next(level, node);
    const auto is_open = [&](int way) { return way != KeySpace::dead && is_open_[level + 1][way] != 0; };
    return decided_[level] < 0 ? std::ranges::any_of(next, is_open) : is_open(next[decided_[level]]);
}

bool OpenPaths::close_unreached(std::size_t level) {
    const std::vector<char>& is_open_before = is_open_[level - 1];
    const int value = decided_[level - 1];
    if (value < 0)
        return close(level, [&](int node) {
            return std::ranges::any_of(space_->previous(level, node),
                                       [&](int before) { return is_open_before[before] != 0; });
        });
    std::vector<char> is_reached(is_open_[level].size(), 0);
    for (const int before : open_[level - 1])
        if (const int node = space_->next(level - 1, before)[value]; node != KeySpace::dead)
            is_reached[node] = 1;
    return close(level, [&](int node) { return is_reached[node] != 0; });
}

bool OpenPaths::close(std::size_t level, const auto& hold) {
    looks_ += open_[level].size();
    return std::erase_if(open_[level], [&](int node) {
               if (hold(node)) return false;
               is_open_[level][node] = 0;
               return true;
           }) > 0;
}

void OpenPaths::decide(std::size_t feature, int value) {
    const std::size_t start = levels_[feature];
    decided_[start] = value;
    for (std::size_t level = start + 1; level < open_.size(); ++level)
        if (!close_unreached(level)) break;
    for (std::size_t level = start + 1; level-- > 0;)
        if (!close(level, [&](int node) { return leads_on(level, node); })) break;
}

}  // namespace gobo
