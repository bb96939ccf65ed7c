#include "lab/commands/cost_pipelines.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/render/render.hpp"

namespace gobo {
namespace {

PipelineKey key_of(const Permutation& permutation) {
    PipelineKey key{permutation.stages};
    for (const SpecializedCount& count : permutation.specialized)
        key.constants.emplace_back(count.id, count.value);
    return key;
}

/// Puts the error where one of the stages first has the name.
void put_at_name(Diagnostic& error, const Composition& composition, const Permutation& permutation,
                 const std::string& name) {
    for (const int stage : permutation.stages.values)
        for (const int number : stage < 0 ? std::vector<int>() : composition.stage(stage).pieces) {
            const Piece& piece = composition.piece(number);
            const std::string& text = piece.text;
            for (const std::string_view token : tokens_of(text)) {
                if (token != name) continue;
                const auto before = text.begin() + (token.data() - text.data());
                const auto lines = static_cast<int>(std::count(text.begin(), before, '\n'));
                return put_at(error, piece, piece.line_in_file(lines + 1));
            }
        }
}

std::string_view bytes_of(const cost::Words& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0])};
}

}  // namespace

bool is_costed(const StageNumbers& stages) {
    StageNumbers compute;
    compute[StageKind::compute] = stages[StageKind::compute];
    return stages.is_usual_pair() || (stages == compute && stages != StageNumbers());
}

cost::CompileOptions compile_options(const CostCommandOptions& options, const World& world) {
    return {.driver = options.driver, .jobs = world.jobs()};
}

Result<cost::Pipeline> pipeline_of(const Composition& composition, const Validated& validated,
                                   const Permutation& permutation) {
    std::vector<cost::PipelineStage> stages;
    std::uint32_t push_bytes = 0;
    for (const StageNames& names : kStages) {
        const int number = permutation.stages[names.kind];
        if (number < 0) continue;
        const ValidatedStage& stage = validated.stage(number);
        stages.push_back({names.kind, stage.spirv});
        for (const Block& block : stage.interface.push_constants)
            push_bytes = std::max(push_bytes, static_cast<std::uint32_t>(block.size));
    }
    const bool is_vulkan = composition.dialect == Dialect::vulkan;
    GOBO_TRY(cost::Pipeline pipeline,
             is_vulkan ? cost::pipeline_of_vulkan(std::move(stages)) : cost::pipeline_of(std::move(stages)));
    pipeline.constants = key_of(permutation).constants;
    pipeline.push_bytes = push_bytes;
    return pipeline;
}

std::string text_of(const CostCommandOptions& options, const Subject& subject,
                    const Permutation& permutation) {
    const std::string key = key_text(subject.family.family, permutation.key);
    if (!subject.are_files) return key;
    const bool is_only = subject.composition.permutations.size() == 1;
    return join(options.names, " ") + (is_only ? "" : " " + key);
}

Pipelines pipelines_of(const CostCommandOptions& options, const Subject& subject,
                       const Validated& validated) {
    Pipelines pipelines;
    std::set<PipelineKey> seen;
    for (const Permutation& permutation : subject.composition.permutations) {
        if (!seen.insert(key_of(permutation)).second) continue;
        auto pipeline = pipeline_of(subject.composition, validated, permutation);
        if (pipeline) {
            pipelines.numbers[key_of(permutation)] = pipelines.list.size();
            pipelines.list.push_back(*std::move(pipeline));
            continue;
        }
        for (Diagnostic& error : pipeline.error()) {
            put_at_name(error, subject.composition, permutation, error.subject);
            error.subject = text_of(options, subject, permutation);
            pipelines.errors.push_back(std::move(error));
        }
    }
    return pipelines;
}

Diagnostics report_failure(const World& world, const CostCommandOptions& options, const cost::Chip& chip,
                           const cost::Pipeline& pipeline, const std::string& key,
                           const std::string& reason) {
    Diagnostics diagnostics(1);
    Diagnostic& error = diagnostics.front();
    error.message = fmt::format("{} has no figures: the driver {}", chip.name, reason);
    error.subject = key;
    error.help = "keep its stages as SPIR-V with -o DIR, for a report to the driver's makers";
    if (options.folder.empty()) return diagnostics;
    std::string name = picture_name(key);
    std::replace(name.begin(), name.end(), '/', '+');  // of files
    const std::string path = fmt::format("{}/{}.{}", options.folder, chip.name, name);
    std::vector<std::string> files;
    for (const cost::PipelineStage& stage : pipeline.stages) {
        files.push_back(fmt::format("{}.{}.spv", path, names_of(stage.kind).infix));
        if (const auto written = world.disk.write(files.back(), bytes_of(stage.words)); !written)
            append(diagnostics, written.error());
    }
    diagnostics.front().help =
        fmt::format("its stages, for a report to the driver's makers: {}", join(files, ", "));
    return diagnostics;
}

std::vector<cost::ChipCost> costs_of(const World& world, const CostCommandOptions& options,
                                     const Subject& subject, const Pipelines& pipelines,
                                     const std::vector<cost::Chip>& chips, Diagnostics& diagnostics) {
    std::vector<cost::ChipCost> costs;
    const bool has_keys = !subject.composition.permutations.empty();  // not each shard has
    if (pipelines.list.empty() && has_keys) return costs;
    const auto answers =
        cost::compile_on_chips(world.disk, chips, pipelines.list, compile_options(options, world));
    for (std::size_t i = 0; i < chips.size(); ++i) {
        if (!answers[i]) {
            append(diagnostics, answers[i].error());
            continue;
        }
        std::vector<std::vector<cost::StageCost>> stages(pipelines.list.size());
        for (std::size_t number = 0; number < stages.size(); ++number)
            if (const auto& compiled = answers[i]->pipelines[number])
                for (const cost::CompiledStage& stage : *compiled) {
                    const auto varies = [&](const cost::PipelineStage& own) {
                        return own.loop_varies && name_of(own.kind) == stage.stage;
                    };
                    stages[number].push_back(cost::cost_of(
                        stage, chips[i], std::ranges::any_of(pipelines.list[number].stages, varies)));
                }
        cost::ChipCost& cost = costs.emplace_back(cost::ChipCost{chips[i], answers[i]->driver, {}});
        std::vector<bool> is_reported(stages.size());
        for (const Permutation& permutation : subject.composition.permutations) {
            const auto found = pipelines.numbers.find(key_of(permutation));
            if (found == pipelines.numbers.end()) continue;
            const std::size_t number = found->second;
            const std::string key = text_of(options, subject, permutation);
            if (const auto& compiled = answers[i]->pipelines[number]) {
                cost.keys.push_back({key, stages[number]});
            } else if (!is_reported[number]) {
                is_reported[number] = true;
                append(diagnostics, report_failure(world, options, chips[i], pipelines.list[number], key,
                                                   compiled.error()));
            }
        }
        if (cost.keys.empty() && has_keys) costs.pop_back();
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
    const Pipelines pipelines = pipelines_of(options, subject, *validated);
    append(diagnostics, pipelines.errors);
    return costs_of(world, options, subject, pipelines, chips, diagnostics);
}

}  // namespace gobo
