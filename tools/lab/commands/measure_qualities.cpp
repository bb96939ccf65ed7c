#include "lab/commands/measure_qualities.hpp"

#include "budget/qualities.hpp"
#include "lab/commands/study_files.hpp"
#include "lab/study/study.hpp"

namespace gobo {

Result<std::vector<StudiedKey>> measure_qualities(const World& world, const LoadedFamily& family,
                                                  const StudiedEffects& studied, const Key& effects,
                                                  int jobs) {
    const auto weights = load_weights(world, "");
    if (!weights) return tl::unexpected(weights.error());
    auto plan = load_plan(world, family.family, "");
    if (!plan) return tl::unexpected(plan.error());
    std::vector<Key> keys = study::front_qualities(family.family, studied, effects);
    if (studied.empty())
        for (const Choice& choice : single_choices(family.family, effects)) keys.push_back(choice.key);
    study::Journal journal;
    const auto result = study::measure_keys({world.shipped, family.family, family.search, jobs}, effects,
                                            keys, *plan, journal);
    if (!result) return tl::unexpected(result.error());
    return study::studied_keys(*result, *weights);
}

}  // namespace gobo
