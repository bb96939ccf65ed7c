#include "family/cover.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>

#include "family/open_paths.hpp"

namespace gobo {
namespace {

/// The features of one combination and which of their value tuples are still to be covered.
struct Combination {
    std::vector<std::size_t> features;  ///< ascending
    std::vector<std::size_t> strides;   ///< per feature: how far its next value is in `open`
    std::vector<char> open;             ///< per tuple, in mixed radix, last feature fastest
};

std::size_t tuple_index(const Combination& combination, const PartialKey& key) {
    std::size_t index = 0;
    for (std::size_t i = 0; i < combination.features.size(); ++i)
        index += combination.strides[i] * static_cast<std::size_t>(key[combination.features[i]]);
    return index;
}

/// Every set of `strength` features, with the tuples that occur in the space marked open. Walks the diagram
/// from the root: a tuple occurs where following its values, and any values between them, leads somewhere.
class Occurrences {
  public:
    Occurrences(const KeySpace& space, std::size_t strength) : space_(space), strength_(strength) {}

    std::vector<Combination> find() {
        std::vector<std::size_t> features;
        list(0, features);
        follow(0, {1}, {}, 0);
        return std::move(combinations_);
    }

  private:
    /// All sets, in lexicographic order.
    void list(std::size_t first, std::vector<std::size_t>& features) {
        if (features.size() == strength_) {
            numbers_[features] = combinations_.size();
            return combinations_.push_back(closed(features));
        }
        for (std::size_t feature = first; feature < space_.feature_count(); ++feature) {
            features.push_back(feature);
            list(feature + 1, features);
            features.pop_back();
        }
    }

    [[nodiscard]] Combination closed(const std::vector<std::size_t>& features) const {
        Combination combination{features, std::vector<std::size_t>(features.size()), {}};
        std::size_t tuples = 1;
        for (std::size_t i = features.size(); i-- > 0;) {
            combination.strides[i] = tuples;
            tuples *= static_cast<std::size_t>(space_.value_count(features[i]));
        }
        combination.open.assign(tuples, 0);
        return combination;
    }

    /// Nodes of the next level that `nodes` lead to by a value, or by any.
    [[nodiscard]] std::vector<char> step(std::size_t level, const std::vector<char>& nodes, int value) const {
        std::vector<char> reached(space_.level(level + 1).size(), 0);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            if (nodes[node] == 0) continue;
            const std::vector<int>& next = space_.level(level)[node].next;
            const std::size_t first = value < 0 ? 0 : static_cast<std::size_t>(value);
            const std::size_t end = value < 0 ? next.size() : first + 1;
            for (std::size_t at = first; at < end; ++at)
                if (next[at] != KeySpace::dead) reached[static_cast<std::size_t>(next[at])] = 1;
        }
        return reached;
    }

    /// Chooses the next feature of a tuple, and its value, in every way. `nodes` are those of `level` that
    /// the values chosen so far lead to.
    void follow(std::size_t level, std::vector<char> nodes, const std::vector<std::size_t>& features,
                std::size_t tuple) {
        for (; level < space_.feature_count(); ++level) {
            std::vector<std::size_t> chosen = features;
            chosen.push_back(level);
            if (space_.feature_count() - level >= strength_ - features.size())
                take(level, nodes, chosen, tuple);
            nodes = step(level, nodes, -1);
        }
    }

    void take(std::size_t level, const std::vector<char>& nodes, const std::vector<std::size_t>& chosen,
              std::size_t tuple) {
        const auto values = static_cast<std::size_t>(space_.value_count(level));
        const bool is_last = chosen.size() == strength_;
        Combination* combination = is_last ? &combinations_[numbers_.at(chosen)] : nullptr;
        for (std::size_t value = 0; value < values; ++value) {
            const std::vector<char> reached = step(level, nodes, static_cast<int>(value));
            if (std::find(reached.begin(), reached.end(), 1) == reached.end()) continue;
            const std::size_t next = tuple * values + value;
            if (is_last)
                combination->open[next] = 1;
            else
                follow(level + 1, reached, chosen, next);
        }
    }

    const KeySpace& space_;
    std::size_t strength_;
    std::vector<Combination> combinations_;
    std::map<std::vector<std::size_t>, std::size_t> numbers_;
};

class Coverer {
  public:
    Coverer(const KeySpace& space, std::size_t strength)
        : space_(space),
          combinations_(Occurrences(space, strength).find()),
          touching_(space.feature_count()),
          nothing_decided_(space) {
        for (std::size_t i = 0; i < combinations_.size(); ++i)
            for (std::size_t k = 0; k < combinations_[i].features.size(); ++k)
                touching_[combinations_[i].features[k]].push_back({i, k});
    }

    std::vector<Key> run() {
        std::vector<Key> keys;
        PartialKey start;
        while (next_start(start)) {
            Attempt best;
            for (int i = 0; i < attempts; ++i) {
                Attempt attempt = complete(start);
                if (best.key.empty() || attempt.gain > best.gain) best = std::move(attempt);
            }
            mark(best.key);
            keys.push_back(std::move(best.key));
        }
        std::sort(keys.begin(), keys.end());
        return keys;
    }

  private:
    /// Orders of features tried for each key; more gave covers smaller by under one per cent.
    static constexpr int attempts = 6;

    /// A key, and how many open tuples it has besides the one that it began with.
    struct Attempt {
        Key key;
        std::size_t gain = 0;
    };

    /// The first tuple still open, as a key to start from. Combinations before the cursor hold none.
    bool next_start(PartialKey& start) {
        for (; cursor_ < combinations_.size(); ++cursor_) {
            const Combination& combination = combinations_[cursor_];
            const auto open = std::find(combination.open.begin(), combination.open.end(), 1);
            if (open == combination.open.end()) continue;
            auto index = static_cast<std::size_t>(open - combination.open.begin());
            start.assign(space_.feature_count(), -1);
            for (std::size_t i = 0; i < combination.features.size(); ++i) {
                start[combination.features[i]] = static_cast<int>(index / combination.strides[i]);
                index %= combination.strides[i];
            }
            return true;
        }
        return false;
    }

    Attempt complete(const PartialKey& start) {
        Attempt attempt{start, 0};
        OpenPaths paths = nothing_decided_;
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < start.size(); ++i) {
            if (start[i] < 0)
                order.push_back(i);
            else
                paths.decide(i, start[i]);
        }
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_() % i]);
        for (const std::size_t feature : order) {
            attempt.gain += decide_best(attempt.key, feature, paths);
            paths.decide(feature, attempt.key[feature]);
        }
        return attempt;
    }

    /// Gives the feature the value that covers most open tuples with what is decided already, of those that
    /// some key still allows; the number of those tuples.
    std::size_t decide_best(PartialKey& key, std::size_t feature, const OpenPaths& paths) {
        const std::vector<char> allowed = paths.allowed(feature);
        const std::vector<std::size_t> gains = gains_of(key, feature);
        const std::size_t count = allowed.size();
        const std::size_t first = random_() % count;  // so that ties take turns
        std::size_t best_gain = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t value = (first + i) % count;
            if (allowed[value] == 0 || (key[feature] >= 0 && gains[value] <= best_gain)) continue;
            key[feature] = static_cast<int>(value);
            best_gain = gains[value];
        }
        return best_gain;
    }

    /// Per value of the feature: how many open tuples it makes up with what is decided already.
    [[nodiscard]] std::vector<std::size_t> gains_of(const PartialKey& key, std::size_t feature) const {
        std::vector<std::size_t> gains(static_cast<std::size_t>(space_.value_count(feature)), 0);
        for (const auto& [number, place] : touching_[feature]) {
            const Combination& combination = combinations_[number];
            std::size_t index = 0;
            bool is_decided = true;
            for (std::size_t i = 0; i < combination.features.size() && is_decided; ++i) {
                if (i == place) continue;
                const int value = key[combination.features[i]];
                is_decided = value >= 0;
                index += combination.strides[i] * static_cast<std::size_t>(value);
            }
            if (!is_decided) continue;
            for (std::size_t value = 0; value < gains.size(); ++value)
                gains[value] += combination.open[index + value * combination.strides[place]] != 0 ? 1 : 0;
        }
        return gains;
    }

    void mark(const Key& key) {
        for (Combination& combination : combinations_) combination.open[tuple_index(combination, key)] = 0;
    }

    /// A combination that names a feature, and which of its features that is.
    struct Touch {
        std::size_t combination;
        std::size_t place;
    };

    const KeySpace& space_;
    std::vector<Combination> combinations_;
    std::vector<std::vector<Touch>> touching_;  ///< per feature
    OpenPaths nothing_decided_;
    std::size_t cursor_ = 0;
    std::mt19937 random_{20231};  // a fixed seed: the same cover everywhere
};

}  // namespace

std::vector<Key> cover(const KeySpace& space, int strength) {
    if (space.count() == 0 || strength < 1) return {};
    if (static_cast<std::size_t>(strength) >= space.feature_count()) return space.keys();
    return Coverer(space, static_cast<std::size_t>(strength)).run();
}

}  // namespace gobo
