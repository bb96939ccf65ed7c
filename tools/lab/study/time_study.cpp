#include "lab/study/time_study.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "lab/study/front.hpp"
#include "lab/study/measurement_json.hpp"
#include "budget/qualities.hpp"

namespace gobo::study {
namespace {

Priced over_all_scenes(const KeyResult& result, const Weights& weights) {
    Priced priced;
    for (const Measurement& measured : result.scenes) {
        priced.error = std::max(priced.error, measured.total.max);
        priced.cost += costs_of(measured, weights).total;
    }
    return priced;
}

/// The indices of the keys to time: the most accurate one, the single choices, the front.
std::vector<std::size_t> chosen(const Family& family, const EffectsResult& effects, const Weights& weights) {
    const std::size_t singles = single_choices(family, effects.effects).size();
    std::vector<Priced> points;
    for (const KeyResult& result : effects.keys) points.push_back(over_all_scenes(result, weights));
    const auto by = dominators(points);
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < effects.keys.size() && indices.size() < kMostTimed; ++i)
        if (i <= singles || !by[i]) indices.push_back(i);
    return indices;
}

Result<TimedGroup> time_group(const FileSystem& shipped, const Family& family, const SearchPath& search,
                              const Context& context, const TimeOptions& options, Journal& journal,
                              const StudyPlan& plan, const std::vector<Key>& keys) {
    const Result<Variants> variants = load_variants(family, search, keys, options.jobs);
    if (!variants) return tl::unexpected(variants.error());
    const Result<DrawnScene> scene = draw_scene(shipped, family, plan.scenes.front());
    if (!scene) return tl::unexpected(scene.error());
    std::string text = fmt::format("times 1 {} {} {} {}", options.machine, context.renderer(), options.rounds,
                                   scene->identity);
    for (const Key& key : keys) text += fmt::format(" {:x}", variants->at(key).hash);
    const std::string identity = identity_of_text(text);
    if (const auto known = journal.find(identity))
        if (const auto group = timed_group_of(*known); group && group->timings.size() == keys.size())
            return *group;
    const auto group = time_variants(context, family, *variants, keys, *scene, options.rounds);
    if (!group) return group;
    if (auto added = journal.add(identity, to_json(*group)); !added) return tl::unexpected(added.error());
    return group;
}

}  // namespace

Result<void> time_study(const FileSystem& shipped, const Family& family, const SearchPath& search,
                        const Context& context, const Weights& weights, const TimeOptions& options,
                        Journal& journal, Study& study) {
    for (std::size_t e = 0; e < study.effects.size(); ++e) {
        EffectsResult& effects = study.effects[e];
        options.progress("timing " + key_text(family, effects.effects), e, study.effects.size());
        const std::vector<std::size_t> indices = chosen(family, effects, weights);
        std::vector<Key> keys;
        for (const std::size_t i : indices) keys.push_back(effects.keys[i].key);
        const auto group = time_group(shipped, family, search, context, options, journal, study.plan, keys);
        if (!group) return tl::unexpected(group.error());
        for (std::size_t i = 0; i < indices.size(); ++i) effects.keys[indices[i]].timing = group->timings[i];
        effects.control = group->control;
    }
    options.progress("", study.effects.size(), study.effects.size());
    return {};
}

const Slopes& ranked_slopes(const Timing& timing) {
    return draws_in_calling_thread(timing.renderer) ? timing.processor : timing.elapsed;
}

CostAndTime cost_against_time(const Study& study, const Weights& weights, bool of_vertices) {
    CostAndTime result;
    for (const EffectsResult& effects : study.effects) {
        for (const KeyResult& key : effects.keys) {
            if (!key.timing) continue;
            const Costs costs = costs_of(key.scenes.front(), weights);
            const Slopes& slopes = ranked_slopes(*key.timing);
            result.cost.push_back(of_vertices ? costs.vertex : costs.fragment);
            result.nanoseconds.push_back(of_vertices ? slopes.vertex.median : slopes.fragment.median);
        }
    }
    result.correlation = rank_correlation(result.cost, result.nanoseconds);
    return result;
}

}  // namespace gobo::study
