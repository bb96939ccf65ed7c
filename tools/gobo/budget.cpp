#include "gobo/budget.hpp"

#include <map>

#include <fmt/format.h>

#include "budget/qualities.hpp"
#include "compose/dialect.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

Budget budget_of(const BudgetOptions& options) {
    Budget budget;
    if (options.max_error > 0) budget.max_error = options.max_error;
    if (options.max_cost > 0) budget.max_cost = options.max_cost;
    return budget;
}

/// A family without a study has none to choose from: what it calls for is measured, at every single choice.
Result<StudiedEffects> load_studied(const World& world, LoadedFamily& family, const BudgetOptions& options) {
    if (!options.study.empty()) {
        const Result<std::string> text = read_input(world, options.study);
        if (!text) return tl::unexpected(text.error());
        if (options.study != "-") family.files.push_back(options.study);
        return read_studied(*text, options.study, family.family);
    }
    const std::string path = fmt::format("data/study/{}.csv", family.family.name);
    if (!world.shipped.is_file(path)) return StudiedEffects{};
    return read_studied(world.shipped.read(path).value(), path, family.family);
}

/// The key that the budget chooses for one combination of effects.
Result<QualityChoice> choose_for(const World& world, const LoadedFamily& family,
                                 const StudiedEffects& studied, const Budget& budget, const Key& effects,
                                 std::string_view dialect, int jobs) {
    const auto found = studied.find(effects);
    const bool is_studied = found != studied.end();
    auto keys = is_studied ? Result<std::vector<StudiedKey>>(found->second)
                           : world.measure(world, family, studied, effects, jobs);
    if (!keys) return tl::unexpected(keys.error());
    std::erase_if(*keys, [&](const StudiedKey& key) {
        return forbidding_rule(family.family, key.key, dialect) != nullptr;
    });
    const auto chosen = choose(*keys, budget, key_text(family.family, effects));
    if (!chosen) return tl::unexpected(chosen.error());
    return QualityChoice{chosen->key, kSafety * chosen->error, chosen->error, chosen->cost,
                         is_studied ? "study" : "measured"};
}

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
    std::map<Key, QualityChoice> chosen;
    Diagnostics problems;
    std::vector<QualityChoice> choices;
    for (const Key& key : keys) {
        const Key effects = effects_of(family.family, key);
        if (!chosen.contains(effects)) {
            const auto choice =
                choose_for(world, family, *studied, budget_of(options), effects, dialect, jobs);
            if (!choice) problems.insert(problems.end(), choice.error().begin(), choice.error().end());
            chosen[effects] = choice.value_or(QualityChoice{});
        }
        choices.push_back(chosen[effects]);
    }
    if (!problems.empty()) return tl::unexpected(problems);
    return choices;
}

}  // namespace gobo
