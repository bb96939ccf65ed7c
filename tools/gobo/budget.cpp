// Budgets on the command line: which quality each combination of effects is built with.
#include "budget/budget.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "gobo/input.hpp"

namespace gobo {
namespace {

/// A family without a study has none to choose from: what it needs is measured, at every single choice.
Result<StudiedEffects> load_studied(const World& world, LoadedFamily& family, const BudgetOptions& options) {
    const std::string shipped = fmt::format("data/study/{}.csv", family.family.name);
    if (options.study.empty() && !world.shipped.is_file(shipped)) return StudiedEffects{};
    GOBO_TRY(const auto study, read_or_shipped(world, options.study, shipped));
    if (!options.study.empty() && options.study != "-") family.files.push_back(options.study);
    return read_studied(study.text, study.path, family.family, split(join(options.gpus, ","), ','));
}

/// The worst error of each quality value over the whole domain, by effects and its text, "power=squaring"; of
/// all effects together by "".
using WorstErrors = std::map<std::pair<std::string, std::string>, double>;

/// Those that came with the family; none where there are none.
WorstErrors load_worst_errors(const World& world, const Family& family) {
    WorstErrors errors;
    const auto text = world.shipped.read(fmt::format("data/study/{}_worst.csv", family.name));
    if (!text) return errors;
    const CsvTable table = read_csv(*text);
    const auto effects = table.column("effects");
    const auto quality = table.column("quality");
    const auto worst = table.column("worst");
    if (!effects || !quality || !worst) return errors;
    for (const auto& row : table.rows)
        if (const auto number = number_in_cell(row[*worst]))
            for (const std::string& of : {row[*effects], std::string()}) {
                double& known = errors[{of, row[*quality]}];
                known = std::max(known, *number);
            }
    return errors;
}

/// Of a key the worst among its values, with these effects where they were searched; nothing where no value
/// is known.
std::optional<double> worst_error_of(const Family& family, const Key& key, const std::string& effects,
                                     const WorstErrors& errors) {
    std::optional<double> worst;
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        const Feature& feature = family.features[i];
        if (feature.role != Role::quality) continue;
        const std::string value =
            fmt::format("{}={}", feature.name, feature.values[static_cast<std::size_t>(key[i])]);
        auto found = errors.find({effects, value});
        if (found == errors.end()) found = errors.find({"", value});
        if (found != errors.end()) worst = std::max(worst.value_or(0), found->second);
    }
    return worst;
}

/// The key that the budget chooses for one combination of effects.
Result<QualityChoice> choose_for(const World& world, const LoadedFamily& family,
                                 const StudiedEffects& studied, const WorstErrors& worst,
                                 const BudgetOptions& options, const Key& effects) {
    const std::string text = key_text(family.family, effects);
    const auto found = studied.find(effects);
    const bool is_studied = found != studied.end();
    if (!is_studied && !options.gpus.empty())
        return fail(
            {.message = "no study has measured these effects, so there are no cycles to choose by",
             .help = fmt::format("study them: gobo study {} --effects '{}' --no-time --gpu {} -o study",
                                 family.name, text, join(options.gpus, ",")),
             .subject = text});
    if (!is_studied && !world.measure)
        return fail(
            Fault::needs_lab, fmt::format("no study has measured '{}': that needs gobo-lab", text),
            fmt::format(
                "; or have it measured elsewhere, gobo study {} --effects '{}' --no-time -o study, and "
                "choose by --study study/study.csv",
                family.name, text));
    GOBO_TRY(auto keys, is_studied ? found->second : world.measure(world, family, studied, effects));
    std::erase_if(keys, [&](const StudiedKey& key) {
        const bool has_cost = options.gpus.empty() || std::isfinite(key.cost);
        return !has_cost || forbidding_rule(family.family, key.key, name_of(family.dialect)) != nullptr;
    });
    GOBO_TRY(const StudiedKey chosen, choose(keys, options, text));
    return QualityChoice{chosen.key,   kSafety * chosen.error,
                         chosen.error, worst_error_of(family.family, chosen.key, text, worst),
                         chosen.cost,  is_studied ? "study" : "measured"};
}

}  // namespace

OptionGroup budget_options(BudgetOptions& options) {
    return {
        "Choice by a budget",
        {{"--max-error", "X",
          "For each combination of effects choose the cheapest quality that promises no larger error, in "
          "linear radiance",
          &options.max_error, kPositive},
         {"--max-cost", "Y",
          "Choose the most accurate quality that costs no more, in additions a fragment; with --max-error a "
          "second limit",
          &options.max_cost, kPositive},
         {"--gpu", "A,B,...",
          "Cost is a chip's cycles for 64 fragments, as --study holds them; of several chips the worst, each "
          "relative to its cheapest quality",
          &options.gpus},
         {"--study", "FILE",
          "The study.csv or summary.csv to choose by; by default the one that came with the family",
          &options.study}}};
}

Result<void> refuse_without_budget(const BudgetOptions& options) {
    if (options.is_set() || (options.gpus.empty() && options.study.empty())) return {};
    return fail(Fault::usage,
                fmt::format("{} says how a budget chooses qualities, and there is none",
                            options.gpus.empty() ? "--study" : "--gpu"),
                "state one: --max-error 0.01, or --max-cost 500");
}

Result<std::vector<QualityChoice>> choose_qualities(const World& world, LoadedFamily& family,
                                                    const BudgetOptions& options,
                                                    const std::vector<Key>& keys) {
    GOBO_TRY(const auto studied, load_studied(world, family, options));
    const WorstErrors worst = load_worst_errors(world, family.family);
    std::map<Key, QualityChoice> chosen;
    Diagnostics problems;
    std::vector<QualityChoice> choices;
    for (const Key& key : keys) {
        const Key effects = effects_of(family.family, key);
        const auto [choice, is_new] = chosen.try_emplace(effects);
        if (is_new) {
            const auto made = choose_for(world, family, studied, worst, options, effects);
            if (made)
                choice->second = *made;
            else
                append(problems, made.error());
        }
        choices.push_back(choice->second);
    }
    if (!problems.empty()) return tl::unexpected(problems);
    return choices;
}

}  // namespace gobo
