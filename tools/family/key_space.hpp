// The set of keys that a family's rules allow, as a decision diagram: counted, walked and asked without
// enumerating.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/whole_number.hpp"
#include "family/family.hpp"

namespace gobo {

/// What a key space ranges over besides the family's rules.
struct KeySpaceLimits {
    std::vector<int> over;  ///< features that vary; the others stand at their defaults. Empty: all vary
    std::vector<Expression> where;  ///< conditions that every key must meet
    bool excluded = false;          ///< whether excluded values take part
};

/// A key in which -1 stands for "any value".
using PartialKey = std::vector<int>;

/// All canonical valid keys of a family within some limits.
///
/// A reduced multi-valued decision diagram: each level decides one feature, and a node stands for what may
/// still follow. Features that the same conditions look at are decided close together, which keeps it small.
/// Two ways after which the same may follow share a node. No node is a dead end.
class KeySpace {
  public:
    /// Fault::input where the rules would make the diagram grow past kMostNodes or kMostBranches; the message
    /// names the rules that do.
    [[nodiscard]] static Result<KeySpace> make(const Family& family, std::string_view dialect,
                                               const KeySpaceLimits& limits);

    /// Before nodes that lead to the same are merged.
    static constexpr std::size_t kMostNodes = 250'000;
    static constexpr std::size_t kMostBranches = 4'000'000;

    /// How many keys there are.
    [[nodiscard]] WholeNumber count() const;

    /// All keys, in lexicographic order of their value indices.
    [[nodiscard]] std::vector<Key> keys() const;

    [[nodiscard]] std::size_t feature_count() const { return feature_at_.size(); }
    [[nodiscard]] std::size_t value_count(std::size_t feature) const { return value_counts_[feature]; }
    [[nodiscard]] int feature_at(std::size_t level) const { return feature_at_[level]; }

    /// No key leads this way.
    static constexpr int dead = -1;

    /// The nodes of a level; level 0 holds the root alone, or nothing where no key is allowed, and one more
    /// level than there are features the end. Every node lies on the way of some key.
    [[nodiscard]] std::size_t node_count(std::size_t level) const { return node_counts_[level]; }

    /// Per value of the level's feature: a node of the next level, or dead.
    [[nodiscard]] std::span<const int> next(std::size_t level, std::size_t node) const {
        const std::size_t count = value_counts_[feature_at_[level]];
        return std::span(branches_[level]).subspan(node * count, count);
    }

    /// The nodes of the level before that some value leads from to the node; the level is not 0.
    [[nodiscard]] std::span<const int> previous(std::size_t level, std::size_t node) const {
        const std::vector<std::size_t>& starts = previous_starts_[level - 1];
        return std::span(previous_[level - 1]).subspan(starts[node], starts[node + 1] - starts[node]);
    }

  private:
    class Builder;
    KeySpace() = default;
    void merge_equal_nodes();
    void find_previous();

    std::vector<int> feature_at_;             ///< per level
    std::vector<std::size_t> value_counts_;   ///< per feature
    std::vector<std::size_t> node_counts_;    ///< per level
    std::vector<std::vector<int>> branches_;  ///< per level: next() of all nodes
    std::vector<std::vector<int>> previous_;  ///< per level but the first: previous() of all nodes
    std::vector<std::vector<std::size_t>> previous_starts_;  ///< and where each node's begin, and the end
};

/// The keys of a key space that agree with what is decided so far, while features are decided in any order.
/// Asking which values a feature may still have costs one look at its level; deciding costs one pass over the
/// diagram at most.
class OpenPaths {
  public:
    /// Nothing is decided. `space` must outlive this.
    explicit OpenPaths(const KeySpace& space);

    /// Per value of the feature: whether some key of the space has it and agrees with all that is decided.
    [[nodiscard]] std::vector<char> allowed(std::size_t feature) const;

    /// Gives the feature the value.
    void decide(std::size_t feature, int value);

    /// How many nodes deciding has looked at so far, in what this is a copy of too: a measure of time.
    [[nodiscard]] std::size_t looks() const { return looks_; }

  private:
    /// Whether what is decided leaves a way from the node of the level to an open one of the next.
    [[nodiscard]] bool leads_on(std::size_t level, int node) const;

    /// Closes the open nodes of a level to which no open one of the level before leads; whether there were
    /// any.
    bool close_unreached(std::size_t level);

    /// Closes the open nodes of a level that do not `hold`; whether there were any.
    bool close(std::size_t level, const auto& hold);

    const KeySpace* space_;
    std::vector<std::size_t> levels_;         ///< of the features
    std::vector<int> decided_;                ///< per level: a value, or -1
    std::vector<std::vector<int>> open_;      ///< per level: the nodes on the way of some key that agrees
    std::vector<std::vector<char>> is_open_;  ///< per level and node: the same
    std::size_t looks_ = 0;
};

}  // namespace gobo
