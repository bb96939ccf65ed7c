// The set of keys that a family's rules allow, as a decision diagram: counted, walked and asked without
// enumerating.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "family/family.hpp"

namespace gobo {

/// What a key space ranges over besides the family's rules.
struct KeySpaceLimits {
    std::vector<int> over;  ///< features that vary; the others stand at their defaults. Empty: all vary
    std::vector<Expression> where;  ///< conditions that every key must meet
    bool retired = false;           ///< whether retired values take part
};

/// A key in which -1 stands for "any value".
using PartialKey = std::vector<int>;

/// All canonical valid keys of a family within some limits.
///
/// A reduced multi-valued decision diagram: level i decides feature i, and a node stands for what may still
/// follow. Two ways after which the same may follow share a node: those that leave the same conditions open,
/// and those whose conditions differ only in how they are written. No node is a dead end.
class KeySpace {
  public:
    KeySpace(const Family& family, std::string_view dialect, const KeySpaceLimits& limits);

    /// How many keys there are; the largest 64-bit number where there are more.
    [[nodiscard]] std::uint64_t count() const;

    /// All keys, in lexicographic order of their value indices.
    [[nodiscard]] std::vector<Key> keys() const;

    /// Whether some key of the space agrees with every decided value.
    [[nodiscard]] bool contains(const PartialKey& partial) const;

    [[nodiscard]] std::size_t feature_count() const { return value_counts_.size(); }
    [[nodiscard]] int value_count(std::size_t feature) const { return value_counts_[feature]; }

    /// No key leads this way.
    static constexpr int dead = -1;

    /// What may still follow once the features before a level are decided.
    struct Node {
        std::vector<int> next;  ///< per value of the level's feature: a node of the next level, or dead
    };

    /// The nodes that decide a feature; level 0 holds the root alone. Every node lies on the way of some key.
    [[nodiscard]] const std::vector<Node>& level(std::size_t feature) const { return levels_[feature]; }

  private:
    std::vector<int> value_counts_;
    std::vector<std::vector<Node>>
        levels_;  ///< levels_[0] holds the root, or nothing where no key is allowed
};

}  // namespace gobo
