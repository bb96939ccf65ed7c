#include "family/key_space.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "family/condition_pool.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

using Id = ConditionPool::Id;
using Comparison = Expression::Comparison;

/// The conditions that make a key canonical and valid: every default rule already fulfilled, no forbid rule
/// met.
std::vector<Id> conditions_of_rules(const Family& family, std::string_view dialect, ConditionPool& pool) {
    std::vector<Id> conditions;
    for (const Rule& rule : family.rules) {
        if (!applies_in(rule, dialect)) continue;
        const Id does_not_apply = pool.negate(pool.add(rule.when));
        if (rule.kind == Rule::Kind::forbid) conditions.push_back(does_not_apply);
        for (const int feature : rule.defaults) {
            conditions.push_back(
                pool.disjoin({does_not_apply, pool.compare({feature}, Comparison::equal, 0)}));
        }
    }
    return conditions;
}

std::vector<Id> conditions_of_limits(const Family& family, const KeySpaceLimits& limits,
                                     ConditionPool& pool) {
    std::vector<Id> conditions;
    for (const Expression& condition : limits.where) conditions.push_back(pool.add(condition));
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        const Feature& feature = family.features[i];
        const auto index = static_cast<int>(i);
        const bool varies = limits.over.empty() ||
                            std::find(limits.over.begin(), limits.over.end(), index) != limits.over.end();
        if (!varies) conditions.push_back(pool.compare({index}, Comparison::equal, 0));
        if (limits.retired) continue;
        for (const std::string& value : feature.retired) {
            conditions.push_back(
                pool.compare({index}, Comparison::not_equal, feature.index_of(value).value_or(-1)));
        }
    }
    return conditions;
}

std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return a > most - b ? most : a + b;
}

/// Builds the diagram from the root down; a node is made once everything below it is known to be no dead end.
template <class Node>
class Builder {
  public:
    Builder(ConditionPool& pool, const std::vector<int>& value_counts, std::vector<std::vector<Node>>& levels,
            int dead)
        : pool_(pool),
          value_counts_(value_counts),
          levels_(levels),
          dead_(dead),
          known_(value_counts.size()),
          made_(value_counts.size()) {}

    /// The node of `level` for these open conditions (their conjunction as one), or dead.
    int build(std::size_t level, Id open) {
        if (open == ConditionPool::never) return dead_;
        if (level == value_counts_.size()) return 0;
        if (const auto found = known_[level].find(open); found != known_[level].end()) return found->second;
        Node node;
        for (int value = 0; value < value_counts_[level]; ++value) {
            node.next.push_back(build(level + 1, pool_.assign(open, static_cast<int>(level), value)));
        }
        int index = dead_;
        if (std::any_of(node.next.begin(), node.next.end(), [&](int next) { return next != dead_; })) {
            const auto [same, is_new] =
                made_[level].try_emplace(node.next, static_cast<int>(levels_[level].size()));
            index = same->second;
            if (is_new) levels_[level].push_back(std::move(node));
        }
        known_[level].emplace(open, index);
        return index;
    }

  private:
    ConditionPool& pool_;
    const std::vector<int>& value_counts_;
    std::vector<std::vector<Node>>& levels_;
    int dead_;
    std::vector<std::map<Id, int>> known_;               ///< per level: nodes by their open conditions
    std::vector<std::map<std::vector<int>, int>> made_;  ///< per level: nodes by where they lead
};

}  // namespace

KeySpace::KeySpace(const Family& family, std::string_view dialect, const KeySpaceLimits& limits) {
    for (const Feature& feature : family.features)
        value_counts_.push_back(static_cast<int>(feature.values.size()));
    levels_.resize(value_counts_.size() + 1);
    ConditionPool pool(family.features);
    std::vector<Id> conditions = conditions_of_rules(family, dialect, pool);
    const std::vector<Id> more = conditions_of_limits(family, limits, pool);
    conditions.insert(conditions.end(), more.begin(), more.end());
    const Id all = pool.conjoin(std::move(conditions));
    if (Builder<Node>(pool, value_counts_, levels_, dead).build(0, all) != dead) levels_.back().push_back({});
}

std::uint64_t KeySpace::count() const {
    std::vector<std::uint64_t> below(levels_.back().size(), 1);
    for (std::size_t level = value_counts_.size(); level-- > 0;) {
        std::vector<std::uint64_t> here(levels_[level].size(), 0);
        for (std::size_t i = 0; i < here.size(); ++i) {
            for (const int next : levels_[level][i].next) {
                if (next != dead) here[i] = saturating_sum(here[i], below[static_cast<std::size_t>(next)]);
            }
        }
        below = std::move(here);
    }
    return below.empty() ? 0 : below.front();
}

std::vector<Key> KeySpace::keys() const {
    std::vector<Key> found;
    if (levels_.front().empty()) return found;
    Key key(value_counts_.size(), 0);
    const auto walk = [&](const auto& self, std::size_t level, int node) -> void {
        if (level == value_counts_.size()) {
            found.push_back(key);
            return;
        }
        const Node& here = levels_[level][static_cast<std::size_t>(node)];
        for (int value = 0; value < value_counts_[level]; ++value) {
            const int next = here.next[static_cast<std::size_t>(value)];
            if (next == dead) continue;
            key[level] = value;
            self(self, level + 1, next);
        }
    };
    // A dead root is never stored, so the root is the last node that level 0 got: its only one.
    walk(walk, 0, 0);
    return found;
}

bool KeySpace::contains(const PartialKey& partial) const {
    std::vector<char> reached(levels_.front().size(), 1);
    for (std::size_t level = 0; level < value_counts_.size(); ++level) {
        std::vector<char> next_reached(levels_[level + 1].size(), 0);
        const int wanted = partial[level];
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i] == 0) continue;
            const std::vector<int>& next = levels_[level][i].next;
            const int first = wanted < 0 ? 0 : wanted;
            const int last = wanted < 0 ? value_counts_[level] - 1 : wanted;
            for (int value = first; value <= last; ++value) {
                const int target = next[static_cast<std::size_t>(value)];
                if (target != dead) next_reached[static_cast<std::size_t>(target)] = 1;
            }
        }
        reached = std::move(next_reached);
    }
    return std::find(reached.begin(), reached.end(), 1) != reached.end();
}

}  // namespace gobo
