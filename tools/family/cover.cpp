#include "family/cover.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <utility>

namespace gobo {
namespace {

/// The features of one combination and which of their value tuples are still to be covered.
struct Combination {
    std::vector<std::size_t> features;  ///< ascending
    std::vector<std::size_t> strides;   ///< per feature: how far its next value is in `open`
    std::vector<char> open;             ///< per tuple, in mixed radix, last feature fastest
    std::size_t left = 0;               ///< how many are open
    std::size_t first = 0;              ///< none before it is
};

std::size_t tuple_index(const Combination& combination, const PartialKey& key) {
    std::size_t index = 0;
    for (std::size_t i = 0; i < combination.features.size(); ++i)
        index += combination.strides[i] * key[combination.features[i]];
    return index;
}

/// Every set of `strength` features, in lexicographic order, with the tuples that occur in the space open.
class Occurrences {
  public:
    Occurrences(const KeySpace& space, std::size_t strength)
        : space_(space), strength_(strength), key_(space.feature_count(), -1) {}

    std::vector<Combination> find() {
        follow(OpenPaths(space_), {});
        std::vector<Combination> combinations;
        for (auto& [features, combination] : found_) combinations.push_back(std::move(combination));
        return combinations;
    }

  private:
    /// Chooses one more feature than those that are decided in `key_`, and its value, in every way.
    void follow(const OpenPaths& paths, const std::vector<std::size_t>& chosen) {
        std::vector<std::size_t> features = chosen;
        features.push_back(0);
        const std::size_t last = space_.feature_count() - (strength_ - features.size());
        for (std::size_t feature = chosen.empty() ? 0 : chosen.back() + 1; feature < last; ++feature) {
            features.back() = feature;
            const std::vector<char> allowed = paths.allowed(feature);
            Combination* const whole = features.size() == strength_ ? &combination(features) : nullptr;
            for (std::size_t value = 0; value < allowed.size(); ++value) {
                if (allowed[value] == 0) continue;
                key_[feature] = static_cast<int>(value);
                if (whole == nullptr) {
                    OpenPaths further = paths;
                    further.decide(feature, key_[feature]);
                    follow(further, features);
                } else if (std::exchange(whole->open[tuple_index(*whole, key_)], 1) == 0) {
                    ++whole->left;
                }
            }
        }
    }

    Combination& combination(const std::vector<std::size_t>& features) {
        const auto [at, is_new] = found_.try_emplace(features);
        Combination& combination = at->second;
        if (!is_new) return combination;
        combination.features = features;
        combination.strides.resize(features.size());
        std::size_t tuples = 1;
        for (std::size_t i = features.size(); i-- > 0;) {
            combination.strides[i] = tuples;
            tuples *= space_.value_count(features[i]);
        }
        combination.open.assign(tuples, 0);
        return combination;
    }

    const KeySpace& space_;
    std::size_t strength_;
    PartialKey key_;
    std::map<std::vector<std::size_t>, Combination> found_;
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
            OpenPaths paths = nothing_decided_;
            for (std::size_t i = 0; i < start.size(); ++i)
                if (start[i] >= 0) paths.decide(i, start[i]);
            Attempt best;
            for (int i = 0; i < attempts; ++i) {
                Attempt attempt = complete(start, paths);
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
            Combination& combination = combinations_[cursor_];
            if (combination.left == 0) continue;
            while (combination.open[combination.first] == 0) ++combination.first;
            std::size_t index = combination.first;
            start.assign(space_.feature_count(), -1);
            for (std::size_t i = 0; i < combination.features.size(); ++i) {
                start[combination.features[i]] = static_cast<int>(index / combination.strides[i]);
                index %= combination.strides[i];
            }
            return true;
        }
        return false;
    }

    Attempt complete(const PartialKey& start, OpenPaths paths) {
        Attempt attempt{start, 0};
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < start.size(); ++i)
            if (start[i] < 0) order.push_back(i);
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
        std::vector<std::size_t> gains(space_.value_count(feature), 0);
        for (const auto& [number, place] : touching_[feature]) {
            const Combination& combination = combinations_[number];
            std::size_t index = 0;
            bool is_decided = true;
            for (std::size_t i = 0; i < combination.features.size() && is_decided; ++i) {
                if (i == place) continue;
                const int value = key[combination.features[i]];
                is_decided = value >= 0;
                index += combination.strides[i] * value;
            }
            if (!is_decided) continue;
            for (std::size_t value = 0; value < gains.size(); ++value)
                gains[value] += combination.open[index + value * combination.strides[place]] != 0 ? 1 : 0;
        }
        return gains;
    }

    /// Combinations of which nothing is open any more are left out of all further sums.
    void mark(const Key& key) {
        for (std::size_t number = cursor_; number < combinations_.size(); ++number) {
            Combination& combination = combinations_[number];
            if (std::exchange(combination.open[tuple_index(combination, key)], 0) == 0) continue;
            if (--combination.left > 0) continue;
            for (const std::size_t feature : combination.features)
                std::erase_if(touching_[feature],
                              [&](const Touch& touch) { return touch.combination == number; });
        }
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
