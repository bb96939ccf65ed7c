#include "gobo/budget.hpp"

#include <map>

#include <fmt/format.h>

#include "family/key.hpp"
#include "gobo/study_files.hpp"
#include "study/budget.hpp"
#include "study/qualities.hpp"

namespace gobo {
namespace {

study::Budget budget_of(const BudgetOptions& options) {
    study::Budget budget;
    if (options.max_error > 0) budget.max_error = options.max_error;
    if (options.max_cost > 0) budget.max_cost = options.max_cost;
    return budget;
}

/// A family without a study has none to choose from: what it calls for is measured, at every single choice.
Result<study::StudiedEffects> load_studied(const World& world, LoadedFamily& family,
                                           const BudgetOptions& options) {
    if (!options.study.empty()) {
        const Result<std::string> text = read_input(world, options.study);
        if (!text) return tl::unexpected(text.error());
        if (options.study != "-") family.files.push_back(options.study);
        return study::read_studied(*text, options.study, family.family);
    }
    const std::string path = fmt::format("data/study/{}.csv", family.family.name);
    if (!world.shipped.is_file(path)) return study::StudiedEffects{};
    return study::read_studied(world.shipped.read(path).value(), path, family.family);
}

/// Chooses for one combination of effects after the other.
class Chooser {
  public:
    Chooser(const World& world, const LoadedFamily& family, const study::StudiedEffects& studied,
            const study::StudyPlan& plan, const study::Weights& weights, std::string_view dialect, int jobs)
        : world_(world), family_(family), studied_(studied), dialect_(dialect) {
        options_.plan = plan;
        options_.weights = weights;
        options_.jobs = jobs;
    }

    Result<QualityChoice> choose(const Key& effects, const study::Budget& budget) {
        const auto found = studied_.find(effects);
        const bool is_studied = found != studied_.end();
        auto keys = is_studied ? Result<std::vector<study::StudiedKey>>(found->second) : measure(effects);
        if (!keys) return tl::unexpected(keys.error());
        std::erase_if(*keys, [&](const study::StudiedKey& key) {
            return forbidding_rule(family_.family, key.key, dialect_) != nullptr;
        });
        const auto chosen = study::choose(*keys, budget, key_text(family_.family, effects));
        if (!chosen) return tl::unexpected(chosen.error());
        return QualityChoice{chosen->key, study::kSafety * chosen->error, chosen->error, chosen->cost,
                             is_studied ? "study" : "measured"};
    }

  private:
    Result<std::vector<study::StudiedKey>> measure(const Key& effects) {
        std::vector<Key> keys = study::front_qualities(family_.family, studied_, effects);
        if (studied_.empty())
            for (const study::Choice& choice : study::single_choices(family_.family, effects))
                keys.push_back(choice.key);
        const auto result = study::measure_keys(world_.shipped, family_.family, family_.search, effects, keys,
                                                options_, journal_);
        if (!result) return tl::unexpected(result.error());
        return study::studied_keys(*result, options_.weights);
    }

    const World& world_;
    const LoadedFamily& family_;
    const study::StudiedEffects& studied_;
    std::string dialect_;
    study::StudyOptions options_;
    study::Journal journal_;
};

}  // namespace

void add_budget_options(CLI::App& app, BudgetOptions& options) {
    app.add_option(
           "--max-error", options.max_error,
           "Choose for each combination of effects the cheapest quality that promises no larger error, in "
           "linear radiance")
        ->type_name("X")
        ->check(CLI::PositiveNumber);
    app.add_option("--max-cost", options.max_cost,
                   "Choose the most accurate quality that costs no more, in additions a fragment; with "
                   "--max-error a second limit")
        ->type_name("Y")
        ->check(CLI::PositiveNumber);
    app.add_option("--study", options.study,
                   "The study.csv or summary.csv to choose by; by default the one that came with the family")
        ->type_name("FILE");
}

Result<std::vector<QualityChoice>> choose_qualities(const World& world, LoadedFamily& family,
                                                    const BudgetOptions& options,
                                                    const std::vector<Key>& keys, std::string_view dialect,
                                                    int jobs) {
    const auto studied = load_studied(world, family, options);
    if (!studied) return tl::unexpected(studied.error());
    const auto weights = load_weights(world, "");
    if (!weights) return tl::unexpected(weights.error());
    const auto plan = load_plan(world, family.family, "");
    if (!plan) return tl::unexpected(plan.error());
    Chooser chooser(world, family, *studied, *plan, *weights, dialect, jobs);
    std::map<Key, QualityChoice> chosen;
    Diagnostics problems;
    std::vector<QualityChoice> choices;
    for (const Key& key : keys) {
        const Key effects = study::effects_of(family.family, key);
        if (!chosen.contains(effects)) {
            const auto choice = chooser.choose(effects, budget_of(options));
            if (!choice) problems.insert(problems.end(), choice.error().begin(), choice.error().end());
            chosen[effects] = choice.value_or(QualityChoice{});
        }
        choices.push_back(chosen[effects]);
    }
    if (!problems.empty()) return tl::unexpected(problems);
    return choices;
}

}  // namespace gobo
