// The keys of a key space that agree with what is decided so far, while features are decided in any order.
#pragma once

#include <vector>

#include "family/key_space.hpp"

namespace gobo {

/// A key being decided. Asking which values a feature may still have costs one look at its level; deciding
/// costs one pass over the diagram at most.
class OpenPaths {
  public:
    /// Nothing is decided. `space` must outlive this.
    explicit OpenPaths(const KeySpace& space);

    /// Per value of the feature: whether some key of the space has it and agrees with all that is decided.
    [[nodiscard]] std::vector<char> allowed(std::size_t feature) const;

    /// Gives the feature the value.
    void decide(std::size_t feature, int value);

  private:
    void spread_down(std::size_t from);
    void spread_up(std::size_t from);

    const KeySpace& space_;
    PartialKey key_;
    std::vector<std::vector<char>> from_root_;  ///< per level and node: a way leads here from the root
    std::vector<std::vector<char>> to_end_;     ///< per level and node: a way leads from here to the end
};

}  // namespace gobo
