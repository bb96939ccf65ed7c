// Budgets on the command line: which quality each combination of effects is built with.
#include "budget/budget.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "gobo/input.hpp"
#include "gobo/name_lists.hpp"

namespace gobo {
namespace {

/// A family without a study has none to choose from: what it needs is measured, at every single choice.
Result<StudiedEffects> load_studied(const World& world, LoadedFamily& family, const BudgetOptions& options) {
    const std::string shipped = fmt::format("data/study/{}.csv", family.family.name);
    if (options.study.empty() && !world.shipped.is_file(shipped)) return StudiedEffects{};
    GOBO_TRY(const auto study, read_or_shipped(world, options.study, shipped));
    if (!options.study.empty() && options.study != "-") family.files.push_back(options.study);
    GOBO_TRY(const auto gpus, names_in("--gpu", options.gpus));
    return read_studied(study.text, study.path, family.family, gpus);
}

/// The best buy that is promised within the error over the whole domain.
Result<StudiedKey> choose_over_domain(const World& world, const LoadedFamily& family,
                                      const std::vector<StudiedKey>& keys, const BudgetOptions& options,
                                      const std::string& effects) {
    const auto is_promised = [&](const StudiedKey& key) {
        return promised_error(key).value_or(HUGE_VAL) <= options.max_error;
    };
    std::vector<StudiedKey> candidates = within(keys, options);
    if (candidates.empty()) return choose(keys, options, effects);  // says what is nearest
    double least = HUGE_VAL;
    for (std::size_t next = 0; next < candidates.size();) {
        if (is_promised(candidates[next])) return candidates[next];
        // What is known of the whole domain bounds a narrower one.
        const auto is_open = [&](const StudiedKey& key) {
            return !key.worst || (!family.narrowed.empty() && std::isfinite(*key.worst));
        };
        if (!is_open(candidates[next])) {
            least = std::min(least, promised_error(candidates[next++]).value_or(HUGE_VAL));
            continue;
        }
        if (!world.measure.over_domain)
            return fail(
                Fault::needs_lab,
                fmt::format("no study has searched this domain for '{}': that needs gobo-lab", effects),
                "; or choose by the error on scenes alone: --typical");
        std::vector<Key> open;  // as many as there are threads
        std::vector<std::size_t> places;
        for (std::size_t i = next; i < candidates.size() && std::ssize(open) < world.jobs(); ++i) {
            if (!is_open(candidates[i])) continue;
            open.push_back(candidates[i].key);
            places.push_back(i);
        }
        GOBO_TRY(const auto worst, world.measure.over_domain(world, family, open, options.max_error));
        for (std::size_t i = 0; i < places.size(); ++i) {
            StudiedKey& key = candidates[places[i]];
            key.worst = worst[i];
            if (is_promised(key)) continue;
            least = std::min(least, promised_error(key).value_or(HUGE_VAL));
            key.worst = HUGE_VAL;
        }
    }
    return fail(
        {.message = fmt::format("no quality is promised within an error of {} over the whole domain",
                                options.max_error),
         .help = fmt::format(
             "{}narrow the domain to what the application has, --domain FILE, or choose by "
             "the error on scenes alone: --typical",
             std::isfinite(least) ? fmt::format("raise it to {} or more, ", short_number(least)) : ""),
         .subject = effects});
}

/// The key that the budget chooses for one combination of effects.
Result<QualityChoice> choose_for(const World& world, const LoadedFamily& family,
                                 const StudiedEffects& studied, const BudgetOptions& options,
                                 const Key& effects) {
    const std::string text = key_text(family.family, effects);
    const auto found = studied.find(effects);
    const bool is_studied = found != studied.end();
    if (!is_studied && !options.gpus.empty())
        return fail(
            {.message = "no study has measured these effects, so there are no cycles to choose by",
             .help = fmt::format("study them: gobo study {} --effects '{}' --no-time --gpu {} -o study",
                                 family.name, text, join(options.gpus, ",")),
             .subject = text});
    if (!is_studied && !world.measure.on_scenes)
        return fail(
            Fault::needs_lab, fmt::format("no study has measured '{}': that needs gobo-lab", text),
            fmt::format(
                "; or have it measured elsewhere, gobo study {} --effects '{}' --no-time -o study, and "
                "choose by --study study/study.csv",
                family.name, text));
    GOBO_TRY(auto keys,
             is_studied ? found->second : world.measure.on_scenes(world, family, studied, effects));
    std::erase_if(keys, [&](const StudiedKey& key) {
        const bool has_cost = options.gpus.empty() || std::isfinite(key.cost);
        return !has_cost || forbidding_rule(family.family, key.key, name_of(family.dialect)) != nullptr;
    });
    const bool is_over_domain = options.max_error > 0 && !options.typical;
    GOBO_TRY(const StudiedKey chosen, is_over_domain ? choose_over_domain(world, family, keys, options, text)
                                                     : choose(keys, options, text));
    return QualityChoice{chosen.key,  promised_error(chosen),           typical_error(chosen), chosen.error,
                         chosen.cost, is_studied ? "study" : "measured"};
}

}  // namespace

OptionGroup budget_options(BudgetOptions& options) {
    return {
        "Choice by a budget",
        {{"--max-error", "X",
          "For each combination of effects choose the cheapest quality that is promised to err by no more at "
          "any "
          "input of the domain, in linear radiance",
          &options.max_error, kPositive},
         {"--domain", "FILE",
          "A file whose [domain] is narrower than the family's, or a scene (.gltf, .glb) for what it holds: "
          "the "
          "promise, the manifest and check(block) hold over it",
          &options.domain},
         {"--typical", "", "The error need only hold on scenes like the study's, not over the whole domain",
          &options.typical},
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

Result<void> narrow_domains(const World& world, LoadedFamily& family, const std::string& file) {
    if (file.empty()) return {};
    if (is_scene_file(file)) {
        GOBO_TRY(family.narrowed, domains_of_scene(world, family, file));
    } else {
        GOBO_TRY(const std::string text, read_input(world, file));
        GOBO_TRY(family.narrowed, read_domain_file(text, file));
        if (file != "-") family.files.push_back(file);
    }
    GOBO_TRY(family.narrowed, narrow_domains(family.family, family.narrowed));
    return {};
}

Result<void> refuse_scenes_outside(const World& world, LoadedFamily& family,
                                   const std::vector<std::string>& scenes, const BudgetOptions& options) {
    if (options.max_error <= 0 || options.typical) return {};
    Diagnostics errors;
    for (const std::string& path : scenes) {
        GOBO_TRY(const auto held, domains_of_scene(world, family, path));
        for (const Domain& of_scene : held) {
            const auto own = std::ranges::find(family.family.domains, of_scene.name, &Domain::name);
            if (is_within(of_scene, *own)) continue;
            const std::string what = of_scene.low == of_scene.high ? fmt::format("is {:.6g}", of_scene.low)
                                                                   : fmt::format("lies in {:.6g} to {:.6g}",
                                                                                 of_scene.low, of_scene.high);
            errors.push_back({.place = of_scene.place,
                              .message = fmt::format("'{}' {}, and errors are promised from {:.6g} to {:.6g}",
                                                     of_scene.name, what, own->low, own->high),
                              .help = "widen --domain, or promise for scenes like the study's: --typical"});
        }
    }
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    return {};
}

Result<void> refuse_without_budget(const BudgetOptions& options) {
    if (options.typical && options.max_error <= 0)
        return fail(Fault::usage, "--typical says how an error is to hold, and there is none",
                    "state one: --max-error 0.01");
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
    std::map<Key, QualityChoice> chosen;
    Diagnostics problems;
    std::vector<QualityChoice> choices;
    for (const Key& key : keys) {
        const Key effects = effects_of(family.family, key);
        const auto [choice, is_new] = chosen.try_emplace(effects);
        if (is_new) {
            const auto made = choose_for(world, family, studied, options, effects);
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
