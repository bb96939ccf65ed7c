// A study's results as what budgets choose among.
#pragma once

#include <vector>

#include "budget/budget.hpp"
#include "lab/study/study.hpp"

namespace gobo::study {

/// The keys of one combination of effects, over all scenes.
[[nodiscard]] std::vector<StudiedKey> studied_keys(const EffectsResult& result, const Weights& weights);

/// The qualities that lie on the front of any effects of the study, applied to other effects: canonical,
/// valid, each once, the most accurate one first.
[[nodiscard]] std::vector<Key> front_qualities(const Family& family, const StudiedEffects& studied,
                                               const Key& effects);

}  // namespace gobo::study
