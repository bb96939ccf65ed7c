#include "lab/commands/cost_pipelines.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/render/render.hpp"

namespace gobo {
namespace {

Pair pair_of(const Permutation& permutation) {
    Pair pair{permutation.stages[StageKind::vertex], permutation.stages[StageKind::fragment]};
    for (const SpecializedCount& count : permutation.specialized)
        pair.constants.emplace_back(count.id, count.value);
    return pair;
}

/// Puts the error where one of the two stages first has the name.
void put_at_name(Diagnostic& error, const Composition& composition, const Permutation& permutation,
                 const std::string& name) {
    for (const StageKind kind : {StageKind::vertex, StageKind::fragment})
        for (const int number : composition.stage(permutation.stages[kind]).pieces) {
            const std::string& text = composition.piece(number).text;
            for (const std::string_view token : tokens_of(text)) {
                if (token != name) continue;
                const auto before = text.begin() + (token.data() - text.data());
                return put_at(error, composition.piece(number),
                              static_cast<int>(std::count(text.begin(), before, '\n')) + 1);
            }
        }
}

std::string_view bytes_of(const cost::Words& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0])};
}

}  // namespace

cost::CompileOptions compile_options(const CostCommandOptions& options, const World& world) {
    return {.driver = options.driver, .jobs = world.jobs()};
}

Result<cost::Pipeline> pipeline_of(const Composition& composition, const Validated& validated,
                                   const Permutation& permutation) {
    const Pair pair = pair_of(permutation);
    const ValidatedStage& vertex = validated.stage(pair.vertex);
    const ValidatedStage& fragment = validated.stage(pair.fragment);
    const bool is_vulkan = composition.dialect == Dialect::vulkan;
    GOBO_TRY(cost::Pipeline pipeline, is_vulkan ? cost::pipeline_of_vulkan(vertex.spirv, fragment.spirv)
                                                : cost::pipeline_of(vertex.spirv, fragment.spirv));
    pipeline.constants = pair.constants;
    for (const ValidatedStage* stage : {&vertex, &fragment})
        for (const Block& block : stage->interface.push_constants)
            pipeline.push_bytes = std::max(pipeline.push_bytes, static_cast<std::uint32_t>(block.size));
    return pipeline;
}

std::string text_of(const CostCommandOptions& options, const Subject& subject,
                    const Permutation& permutation) {
    const std::string key = key_text(subject.family.family, permutation.key);
    if (!subject.are_files) return key;
    const bool is_only = subject.composition.permutations.size() == 1;
    return join(options.names, " ") + (is_only ? "" : " " + key);
}

Pairs pairs_of(const CostCommandOptions& options, const Subject& subject, const Validated& validated) {
    Pairs pairs;
    std::map<Pair, bool> seen;
    for (const Permutation& permutation : subject.composition.permutations) {
        if (!seen.try_emplace(pair_of(permutation)).second) continue;
        auto pipeline = pipeline_of(subject.composition, validated, permutation);
        if (pipeline) {
            pairs.numbers[pair_of(permutation)] = pairs.pipelines.size();
            pairs.pipelines.push_back(*std::move(pipeline));
            continue;
        }
        for (Diagnostic& error : pipeline.error()) {
            put_at_name(error, subject.composition, permutation, error.subject);
            error.subject = text_of(options, subject, permutation);
            pairs.errors.push_back(std::move(error));
        }
    }
    return pairs;
}

Diagnostics report_failure(const World& world, const CostCommandOptions& options, const cost::Chip& chip,
                           const cost::Pipeline& pipeline, const std::string& key,
                           const std::string& reason) {
    Diagnostics diagnostics(1);
    Diagnostic& error = diagnostics.front();
    error.message = fmt::format("{} has no figures: the driver {}", chip.name, reason);
    error.subject = key;
    error.help = "keep its two stages as SPIR-V with -o DIR, for a report to the driver's makers";
    if (options.folder.empty()) return diagnostics;
    std::string name = picture_name(key);
    std::replace(name.begin(), name.end(), '/', '+');  // of files
    const std::string path = fmt::format("{}/{}.{}", options.folder, chip.name, name);
    error.help =
        fmt::format("its stages, for a report to the driver's makers: {0}.vert.spv, {0}.frag.spv", path);
    for (const auto& [end, words] :
         {std::pair(".vert.spv", &pipeline.vertex), {".frag.spv", &pipeline.fragment}})
        if (const auto written = world.disk.write(path + end, bytes_of(*words)); !written)
            append(diagnostics, written.error());
    return diagnostics;
}

std::vector<cost::ChipCost> costs_of(const World& world, const CostCommandOptions& options,
                                     const Subject& subject, const Pairs& pairs,
                                     const std::vector<cost::Chip>& chips, Diagnostics& diagnostics) {
    std::vector<cost::ChipCost> costs;
    if (pairs.pipelines.empty()) return costs;
    const auto answers =
        cost::compile_on_chips(world.disk, chips, pairs.pipelines, compile_options(options, world));
    for (std::size_t i = 0; i < chips.size(); ++i) {
        if (!answers[i]) {
            append(diagnostics, answers[i].error());
            continue;
        }
        std::vector<std::vector<cost::StageCost>> stages(pairs.pipelines.size());
        for (std::size_t pair = 0; pair < stages.size(); ++pair) {
            const cost::Pipeline& pipeline = pairs.pipelines[pair];
            if (const auto& compiled = answers[i]->pipelines[pair])
                for (const cost::CompiledStage& stage : *compiled)
                    stages[pair].push_back(cost::cost_of(stage, chips[i],
                                                         stage.stage == "vertex"
                                                             ? pipeline.vertex_loop_varies
                                                             : pipeline.fragment_loop_varies));
        }
        cost::ChipCost& cost = costs.emplace_back(cost::ChipCost{chips[i], answers[i]->driver, {}});
        std::vector<bool> is_reported(stages.size());
        for (const Permutation& permutation : subject.composition.permutations) {
            const auto number = pairs.numbers.find(pair_of(permutation));
            if (number == pairs.numbers.end()) continue;
            const std::size_t pair = number->second;
            const std::string key = text_of(options, subject, permutation);
            if (const auto& compiled = answers[i]->pipelines[pair]) {
                cost.keys.push_back({key, stages[pair]});
            } else if (!is_reported[pair]) {
                is_reported[pair] = true;
                append(diagnostics, report_failure(world, options, chips[i], pairs.pipelines[pair], key,
                                                   compiled.error()));
            }
        }
        if (cost.keys.empty()) costs.pop_back();
    }
    return costs;
}
std::vector<cost::ChipCost> costs_of_study(const World& world, const LoadedFamily& family,
                                           const CsvTable& study, const std::string& path,
                                           const std::vector<cost::Chip>& chips, const std::string& driver,
                                           Diagnostics& diagnostics) {
    CostCommandOptions options;
    options.driver = driver;
    Subject subject{.family = family, .composition = {}};
    std::vector<Key> keys;
    const std::size_t at = study.column("key").value();
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        const auto key = parse_key(family.family, study.rows[i][at], {path, static_cast<int>(i) + 2, 0});
        if (!key)
            append(diagnostics, key.error());
        else if (std::find(keys.begin(), keys.end(), *key) == keys.end())
            keys.push_back(*key);
    }
    auto composition = compose_keys(family, keys);
    if (!composition) {
        append(diagnostics, composition.error());
        return {};
    }
    subject.composition = *std::move(composition);
    const auto validated = compile(world, subject, {.keep_spirv = true});
    if (!validated) {
        append(diagnostics, validated.error());
        return {};
    }
    const Pairs pairs = pairs_of(options, subject, *validated);
    append(diagnostics, pairs.errors);
    return costs_of(world, options, subject, pairs, chips, diagnostics);
}

}  // namespace gobo
