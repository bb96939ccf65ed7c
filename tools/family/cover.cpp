#include "family/cover.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>

namespace gobo {
namespace {

/// The features of one combination and which of their value tuples are still to be covered.
struct Combination {
    std::vector<std::size_t> features;  ///< ascending
    std::vector<char> open;             ///< per tuple, in mixed radix, last feature fastest
};

std::size_t tuple_index(const KeySpace& space, const Combination& combination, const PartialKey& key) {
    std::size_t index = 0;
    for (const std::size_t feature : combination.features) {
        index = index * static_cast<std::size_t>(space.value_count(feature)) +
                static_cast<std::size_t>(key[feature]);
    }
    return index;
}

/// The key that decides exactly the combination's features, by the tuple's number.
PartialKey key_of_tuple(const KeySpace& space, const Combination& combination, std::size_t index) {
    PartialKey key(space.feature_count(), -1);
    for (std::size_t i = combination.features.size(); i-- > 0;) {
        const std::size_t feature = combination.features[i];
        const auto values = static_cast<std::size_t>(space.value_count(feature));
        key[feature] = static_cast<int>(index % values);
        index /= values;
    }
    return key;
}

/// Every set of `strength` features, with the tuples that occur in the space marked open.
std::vector<Combination> combinations_of(const KeySpace& space, std::size_t strength) {
    std::vector<Combination> combinations;
    std::vector<std::size_t> features(strength);
    std::iota(features.begin(), features.end(), std::size_t{0});
    const std::size_t count = space.feature_count();
    while (true) {
        Combination combination{features, {}};
        std::size_t tuples = 1;
        for (const std::size_t feature : features)
            tuples *= static_cast<std::size_t>(space.value_count(feature));
        for (std::size_t i = 0; i < tuples; ++i) {
            combination.open.push_back(space.contains(key_of_tuple(space, combination, i)) ? 1 : 0);
        }
        combinations.push_back(std::move(combination));
        std::size_t at = strength;
        while (at > 0 && features[at - 1] == count - strength + at - 1) --at;
        if (at == 0) return combinations;
        ++features[at - 1];
        for (std::size_t i = at; i < strength; ++i) features[i] = features[i - 1] + 1;
    }
}

class Coverer {
  public:
    Coverer(const KeySpace& space, std::size_t strength)
        : space_(space), combinations_(combinations_of(space, strength)), touching_(space.feature_count()) {
        for (std::size_t i = 0; i < combinations_.size(); ++i) {
            for (const std::size_t feature : combinations_[i].features) touching_[feature].push_back(i);
        }
    }

    std::vector<Key> run() {
        std::vector<Key> keys;
        PartialKey start;
        while (next_start(start)) {
            Key best;
            std::size_t best_gain = 0;
            for (int attempt = 0; attempt < attempts; ++attempt) {
                Key key = complete(start);
                const std::size_t gain = gain_of(key);
                if (gain <= best_gain) continue;
                best_gain = gain;
                best = std::move(key);
            }
            mark(best);
            keys.push_back(std::move(best));
        }
        std::sort(keys.begin(), keys.end());
        return keys;
    }

  private:
    /// Orders of features tried for each key; more gave covers smaller by under one per cent.
    static constexpr int attempts = 6;

    /// The first tuple still open, as a key to start from. Combinations before the cursor hold none.
    bool next_start(PartialKey& start) {
        for (; cursor_ < combinations_.size(); ++cursor_) {
            const Combination& combination = combinations_[cursor_];
            const auto open = std::find(combination.open.begin(), combination.open.end(), 1);
            if (open == combination.open.end()) continue;
            start =
                key_of_tuple(space_, combination, static_cast<std::size_t>(open - combination.open.begin()));
            return true;
        }
        return false;
    }

    Key complete(PartialKey key) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < key.size(); ++i) {
            if (key[i] < 0) order.push_back(i);
        }
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_() % i]);
        for (const std::size_t feature : order) key[feature] = best_value(key, feature);
        return key;
    }

    /// The value that covers most open tuples with what is decided already, of those that some key still
    /// allows.
    int best_value(PartialKey& key, std::size_t feature) {
        const int count = space_.value_count(feature);
        const int first =
            static_cast<int>(random_() % static_cast<unsigned>(count));  // so that ties take turns
        int best = -1;
        std::size_t best_gain = 0;
        for (int i = 0; i < count; ++i) {
            key[feature] = (first + i) % count;
            const std::size_t gain = gain_of(key, feature);
            if (best >= 0 && gain <= best_gain) continue;
            if (!space_.contains(key)) continue;
            best = key[feature];
            best_gain = gain;
        }
        key[feature] = -1;
        return best;
    }

    [[nodiscard]] bool is_open(const Combination& combination, const PartialKey& key) const {
        for (const std::size_t feature : combination.features) {
            if (key[feature] < 0) return false;
        }
        return combination.open[tuple_index(space_, combination, key)] != 0;
    }

    [[nodiscard]] std::size_t gain_of(const PartialKey& key, std::size_t feature) const {
        std::size_t gain = 0;
        for (const std::size_t index : touching_[feature]) gain += is_open(combinations_[index], key) ? 1 : 0;
        return gain;
    }

    [[nodiscard]] std::size_t gain_of(const Key& key) const {
        return static_cast<std::size_t>(std::count_if(combinations_.begin(), combinations_.end(),
                                                      [&](const Combination& c) { return is_open(c, key); }));
    }

    void mark(const Key& key) {
        for (Combination& combination : combinations_)
            combination.open[tuple_index(space_, combination, key)] = 0;
    }

    const KeySpace& space_;
    std::vector<Combination> combinations_;
    std::vector<std::vector<std::size_t>> touching_;  ///< per feature: the combinations that name it
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
