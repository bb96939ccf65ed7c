#include "lab/study/choices.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "budget/qualities.hpp"

namespace gobo::study {
namespace {

/// Errors that differ by less than so many times that of the most accurate key, which has nothing but
/// roundings, are alike: which of two such is the smaller is chance.
constexpr double kChance = 2;

bool is_less(const ErrorFigures& first, const ErrorFigures& second, const ErrorFigures& accurate) {
    return first.max + kChance * accurate.max < second.max || first.rms + kChance * accurate.rms < second.rms;
}

/// How two values of a feature compare over all pairs of keys that differ in nothing else.
struct Duel {
    std::size_t pairs = 0;
    bool is_never_worse = true;  ///< the first: neither dearer nor less accurate
    bool is_ever_better = false;

    void add(const Measurement& first, const Measurement& second, const Measurement& accurate,
             const Weights& weights) {
        const double first_cost = costs_of(first, weights).total;
        const double second_cost = costs_of(second, weights).total;
        ++pairs;
        if (first_cost > second_cost || is_less(second.total, first.total, accurate.total))
            is_never_worse = false;
        if (first_cost < second_cost || is_less(first.total, second.total, accurate.total))
            is_ever_better = true;
    }
};

/// All duels between values of one feature, by their numbers.
using Duels = std::map<std::pair<int, int>, Duel>;

Duels duels_of(const Study& study, const Weights& weights, std::size_t feature) {
    Duels duels;
    for (const EffectsResult& effects : study.effects) {
        std::map<Key, std::vector<const KeyResult*>> alike;
        for (const KeyResult& result : effects.keys) {
            Key others = result.key;
            others[feature] = 0;
            alike[others].push_back(&result);
        }
        for (const auto& [others, results] : alike)
            for (const KeyResult* first : results)
                for (const KeyResult* second : results)
                    for (std::size_t scene = 0; first != second && scene < first->scenes.size(); ++scene)
                        duels[{first->key[feature], second->key[feature]}].add(
                            first->scenes[scene], second->scenes[scene], effects.keys.front().scenes[scene],
                            weights);
    }
    return duels;
}

void add_alone(ChoiceSummary& summary, const KeyResult& choice, const KeyResult& accurate,
               const Weights& weights) {
    double cost = 0;
    double accurate_cost = 0;
    for (std::size_t scene = 0; scene < choice.scenes.size(); ++scene) {
        summary.error_max = std::max(summary.error_max, choice.scenes[scene].total.max);
        summary.error_rms = std::max(summary.error_rms, choice.scenes[scene].total.rms);
        cost += costs_of(choice.scenes[scene], weights).total;
        accurate_cost += costs_of(accurate.scenes[scene], weights).total;
    }
    summary.least_cost = std::min(summary.least_cost, cost / accurate_cost);
    summary.most_cost = std::max(summary.most_cost, cost / accurate_cost);
    ++summary.combinations;
}

/// The value alone, in all effects that it matters to; the most accurate value where another one matters.
void measure_alone(const Family& family, const Study& study, const Weights& weights, int feature, int value,
                   ChoiceSummary& summary) {
    summary.least_cost = std::numeric_limits<double>::infinity();
    const int best = most_accurate_value(family.features[static_cast<std::size_t>(feature)]);
    for (const EffectsResult& effects : study.effects) {
        const KeyResult& accurate = effects.keys.front();
        const std::vector<Choice> choices = single_choices(family, effects.effects);
        bool matters = false;
        for (const Choice& choice : choices) {
            if (choice.feature != feature) continue;
            matters = true;
            if (choice.value != value) continue;
            for (const KeyResult& result : effects.keys)
                if (result.key == choice.key) add_alone(summary, result, accurate, weights);
        }
        if (value == best && matters) add_alone(summary, accurate, accurate, weights);
    }
    if (summary.combinations == 0) summary.least_cost = 0;
}

}  // namespace

std::vector<ChoiceSummary> summarise_choices(const Family& family, const Study& study,
                                             const Weights& weights) {
    std::vector<ChoiceSummary> summaries;
    for (const int index : quality_features(family)) {
        const Feature& feature = family.features[static_cast<std::size_t>(index)];
        const Duels duels = duels_of(study, weights, static_cast<std::size_t>(index));
        const int values = static_cast<int>(feature.values.size());
        for (int value = 0; value < values; ++value) {
            ChoiceSummary& summary = summaries.emplace_back();
            summary.feature = feature.name;
            summary.value = feature.values[static_cast<std::size_t>(value)];
            summary.is_most_accurate = value == most_accurate_value(feature);
            summary.is_excluded = std::find(feature.excluded.begin(), feature.excluded.end(),
                                            summary.value) != feature.excluded.end();
            measure_alone(family, study, weights, index, value, summary);
            // Nothing is more accurate than the most accurate value, and it may be there for inputs that no
            // scene has.
            if (summary.is_most_accurate) continue;
            for (int other = 0; other < values && summary.dominated_by.empty(); ++other) {
                const auto duel = duels.find({other, value});
                if (duel == duels.end() || !duel->second.is_never_worse || !duel->second.is_ever_better)
                    continue;
                summary.dominated_by = feature.values[static_cast<std::size_t>(other)];
                summary.pairs = duel->second.pairs;
            }
        }
    }
    return summaries;
}

}  // namespace gobo::study
