#include "lab/study/studied_keys.hpp"

#include <algorithm>
#include <set>

#include "budget/qualities.hpp"
#include "lab/study/front.hpp"

namespace gobo::study {

std::vector<StudiedKey> studied_keys(const EffectsResult& result, const Weights& weights) {
    std::vector<StudiedKey> keys;
    std::vector<Priced> points;
    for (const KeyResult& one : result.keys) {
        StudiedKey& studied = keys.emplace_back();
        studied.key = one.key;
        for (const Measurement& measured : one.scenes) {
            studied.error = std::max(studied.error, measured.total.max);
            studied.cost += costs_of(measured, weights).total / static_cast<double>(one.scenes.size());
        }
        points.push_back({studied.cost, studied.error});
    }
    const auto by = dominators(points);
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i].on_front = !by[i];
    return keys;
}

std::vector<Key> front_qualities(const Family& family, const StudiedEffects& studied, const Key& effects) {
    std::vector<Key> keys = {most_accurate(family, effects)};
    std::set<Key> seen(keys.begin(), keys.end());
    for (const auto& [of, candidates] : studied) {
        for (const StudiedKey& candidate : candidates) {
            Key key = with_quality_of(family, effects, candidate.key);
            if (candidate.on_front && is_valid(family, key) && seen.insert(key).second)
                keys.push_back(std::move(key));
        }
    }
    return keys;
}

}  // namespace gobo::study
