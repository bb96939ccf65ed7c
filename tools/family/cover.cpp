#include "family/cover.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

namespace gobo {
namespace {

/// The features of one combination and which of their value tuples are still to be covered.
struct Combination {
    std::vector<std::size_t> features;  ///< ascending
    std::vector<std::size_t> strides;   ///< per feature: how far its next value is in `open`
    std::vector<char> open;             ///< per tuple, in mixed radix, last feature fastest
    std::size_t left = 0;               ///< how many are open
};

/// Where the key's tuple is in `open`; nothing where not all of it is decided.
std::optional<std::size_t> tuple_index(const Combination& combination, const PartialKey& key) {
    std::size_t index = 0;
    for (std::size_t i = 0; i < combination.features.size(); ++i) {
        const int value = key[combination.features[i]];
        if (value < 0) return std::nullopt;
        index += combination.strides[i] * value;
    }
    return index;
}

Combination combination_of(const KeySpace& space, std::vector<std::size_t> features) {
    Combination combination{std::move(features), {}, {}};
    std::size_t tuples = 1;
    for (std::size_t i = combination.features.size(); i-- > 0;) {
        combination.strides.insert(combination.strides.begin(), tuples);
        tuples *= space.value_count(combination.features[i]);
    }
    combination.open.assign(tuples, 0);
    return combination;
}

/// Per feature the only value that keys of the space have; -1 where they have several.
PartialKey only_values(const KeySpace& space) {
    const OpenPaths paths(space);
    PartialKey only(space.feature_count(), -1);
    for (std::size_t feature = 0; feature < only.size(); ++feature) {
        const std::vector<char> allowed = paths.allowed(feature);
        if (std::ranges::count(allowed, 0) + 1 == std::ssize(allowed))
            only[feature] = static_cast<int>(std::ranges::find(allowed, 1) - allowed.begin());
    }
    return only;
}

/// In how many ways `chosen` of `all` can be chosen.
std::size_t ways(std::size_t all, std::size_t chosen) {
    std::size_t product = 1;
    for (std::size_t i = 0; i < chosen; ++i) product = product * (all - i) / (i + 1);
    return all < chosen ? 0 : product;
}

/// Where a set of numbers below `count`, ascending, stands among all of its size in lexicographic order.
std::size_t position_of(const std::vector<std::size_t>& set, std::size_t count) {
    std::size_t position = 0;
    std::size_t next = 0;  // the first number that could stand here
    for (std::size_t i = 0; i < set.size(); ++i) {
        const std::size_t left = set.size() - i;
        position += ways(count - next, left) - ways(count - set[i], left);
        next = set[i] + 1;
    }
    return position;
}

/// Every set of `strength` of the features, in lexicographic order, with the tuples that occur in the space
/// open. The features: ascending.
std::vector<Combination> find_combinations(const KeySpace& space, std::size_t strength,
                                           const std::vector<std::size_t>& features) {
    std::vector<Combination> found(ways(features.size(), strength));
    PartialKey key(space.feature_count(), -1);
    // Chooses one more feature than those that are decided in `key`, and its value, in every way; `set` has
    // where they stand in `features`.
    const auto follow = [&](const auto& self, const OpenPaths& paths, std::vector<std::size_t> set) -> void {
        const std::size_t first = set.empty() ? 0 : set.back() + 1;
        set.push_back(first);
        for (; set.back() + strength < features.size() + set.size(); ++set.back()) {
            const std::size_t feature = features[set.back()];
            const bool is_whole = set.size() == strength;
            Combination* const whole = is_whole ? &found[position_of(set, features.size())] : nullptr;
            if (is_whole && whole->features.empty()) {
                std::vector<std::size_t> chosen;
                for (const std::size_t at : set) chosen.push_back(features[at]);
                *whole = combination_of(space, std::move(chosen));
            }
            const std::vector<char> allowed = paths.allowed(feature);
            for (std::size_t value = 0; value < allowed.size(); ++value) {
                if (allowed[value] == 0) continue;
                key[feature] = static_cast<int>(value);
                if (!is_whole) {
                    OpenPaths further = paths;
                    further.decide(feature, key[feature]);
                    self(self, further, set);
                } else if (std::exchange(whole->open[*tuple_index(*whole, key)], 1) == 0) {
                    ++whole->left;
                }
            }
        }
    };
    follow(follow, OpenPaths(space), {});
    return found;
}

/// The features that have several values.
std::vector<std::size_t> undecided(const PartialKey& only) {
    std::vector<std::size_t> features;
    for (std::size_t feature = 0; feature < only.size(); ++feature)
        if (only[feature] < 0) features.push_back(feature);
    return features;
}

class Coverer {
  public:
    Coverer(const KeySpace& space, std::size_t strength, PartialKey only)
        : space_(space),
          only_(std::move(only)),
          combinations_(find_combinations(space, strength, undecided(only_))),
          touching_(space.feature_count()),
          nothing_decided_(space) {
        for (Combination& combination : combinations_) {
            for (std::size_t i = 0; i < combination.features.size(); ++i)
                touching_[combination.features[i]].push_back({&combination, combination.strides[i]});
            if (combination.left > 0) open_.push_back(&combination);
            tuples_ += combination.left;
        }
    }

    /// Nothing where it would take too long: what the keys so far took tells.
    std::optional<std::vector<Key>> run() {
        std::vector<Key> keys;
        PartialKey start;
        while (next_start(start)) {
            // The first keys cover most: it takes more than at their rate.
            if (work_ / std::max<std::size_t>(covered_, 1) * tuples_ > most_work) return std::nullopt;
            OpenPaths paths = nothing_decided_;
            for (std::size_t i = 0; i < start.size(); ++i)
                if (start[i] >= 0) paths.decide(i, start[i]);
            Attempt best;
            for (int i = 0; i < (keys.size() < many_keys ? attempts : 1); ++i) {
                Attempt attempt = complete(start, paths);
                if (best.key.empty() || attempt.gain > best.gain) best = std::move(attempt);
            }
            mark(best.key);
            keys.push_back(std::move(best.key));
        }
        std::ranges::sort(keys);
        return keys;
    }

  private:
    /// Orders of features tried for each key; more gave covers smaller by under one per cent.
    static constexpr int attempts = 6;

    /// Keys after which one order is tried: nobody waits for fewer of so many. The cover of `lit` by fours
    /// has 11,322 keys.
    static constexpr std::size_t many_keys = 15'000;

    /// In some ns. The cover of `lit` by fours takes 10'000'000'000.
    static constexpr std::size_t most_work = 20'000'000'000;
    static constexpr std::size_t work_of_look = 25;
    static constexpr std::size_t work_of_combination = 5;

    /// A key, and how many open tuples it has besides the one that it began with.
    struct Attempt {
        Key key;
        std::size_t gain = 0;
    };

    /// The first tuple still open, as a key to start from. Combinations before the cursor hold none.
    bool next_start(PartialKey& start) {
        for (; cursor_ < combinations_.size(); ++cursor_) {
            const Combination& combination = combinations_[cursor_];
            if (combination.left == 0) continue;
            std::size_t index = std::ranges::find(combination.open, 1) - combination.open.begin();
            start = only_;
            for (std::size_t i = 0; i < combination.features.size(); ++i) {
                start[combination.features[i]] = static_cast<int>(index / combination.strides[i]);
                index %= combination.strides[i];
            }
            return true;
        }
        return false;
    }

    Attempt complete(const PartialKey& start, OpenPaths paths) {
        const std::size_t looks_before = paths.looks();
        Attempt attempt{start, 0};
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < start.size(); ++i)
            if (start[i] < 0) order.push_back(i);
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_() % i]);
        for (const std::size_t feature : order) {
            const std::vector<char> allowed = paths.allowed(feature);
            attempt.gain += decide_best(attempt.key, feature, allowed);
            // Where one value alone is left, deciding it closes nothing.
            if (std::ranges::count(allowed, 1) > 1) paths.decide(feature, attempt.key[feature]);
        }
        work_ += (paths.looks() - looks_before) * work_of_look;
        return attempt;
    }

    /// Gives the feature the value that covers most open tuples with what is decided already, of those that
    /// some key still allows; the number of those tuples.
    std::size_t decide_best(PartialKey& key, std::size_t feature, const std::vector<char>& allowed) {
        const std::vector<std::size_t> gains = gains_of(key, feature);
        const std::size_t first = random_() % allowed.size();  // so that ties take turns
        std::size_t best_gain = 0;
        for (std::size_t i = 0; i < allowed.size(); ++i) {
            const std::size_t value = (first + i) % allowed.size();
            if (allowed[value] == 0 || (key[feature] >= 0 && gains[value] <= best_gain)) continue;
            key[feature] = static_cast<int>(value);
            best_gain = gains[value];
        }
        return best_gain;
    }

    /// Per value of the feature: how many open tuples it makes up with what is decided already.
    [[nodiscard]] std::vector<std::size_t> gains_of(PartialKey& key, std::size_t feature) {
        work_ += touching_[feature].size() * work_of_combination;
        key[feature] = 0;  // only for the index of the first tuple
        std::vector<std::size_t> gains(space_.value_count(feature), 0);
        for (const auto& [combination, stride] : touching_[feature]) {
            const std::optional<std::size_t> first = tuple_index(*combination, key);
            if (!first) continue;
            work_ += gains.size();
            for (std::size_t value = 0; value < gains.size(); ++value)
                gains[value] += combination->open[*first + value * stride];
        }
        key[feature] = -1;
        return gains;
    }

    /// Combinations of which nothing is open any more are left out of all further sums.
    void mark(const Key& key) {
        work_ += open_.size() * work_of_combination;
        std::vector<char> has_closed(touching_.size(), 0);
        std::erase_if(open_, [&](Combination* combination) {
            if (std::exchange(combination->open[*tuple_index(*combination, key)], 0) == 0) return false;
            ++covered_;
            if (--combination->left > 0) return false;
            for (const std::size_t feature : combination->features) has_closed[feature] = 1;
            return true;
        });
        for (std::size_t feature = 0; feature < touching_.size(); ++feature)
            if (has_closed[feature] != 0)
                std::erase_if(touching_[feature],
                              [](const Touch& touch) { return touch.combination->left == 0; });
    }

    /// A combination that names a feature, and how far that feature's next value is in it.
    struct Touch {
        const Combination* combination;
        std::size_t stride;
    };

    const KeySpace& space_;
    PartialKey only_;  ///< what is decided before any key
    std::vector<Combination> combinations_;
    std::vector<std::vector<Touch>> touching_;  ///< per feature
    std::vector<Combination*> open_;            ///< those of which something is open
    OpenPaths nothing_decided_;
    std::size_t cursor_ = 0;
    std::size_t tuples_ = 0;  ///< that there are to cover
    std::size_t covered_ = 0;
    std::size_t work_ = 0;
    std::mt19937 random_{20231};  // a fixed seed: the same cover everywhere
};

}  // namespace

std::optional<std::vector<Key>> cover(const KeySpace& space, int strength) {
    if (space.count() == 0 || strength < 1) return std::vector<Key>{};
    PartialKey only = only_values(space);
    if (strength >= std::ranges::count(only, -1)) return space.keys();
    return Coverer(space, static_cast<std::size_t>(strength), std::move(only)).run();
}

}  // namespace gobo
