// gobo cost --specialized: counts as constants of the pipeline against the same counts as numbers.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/commands/cost_pipelines.hpp"
#include "spirv/transform.hpp"

namespace gobo {
namespace {

/// Distinct modules without their names, and their bytes.
struct Modules {
    std::set<cost::Words> distinct;
    std::size_t bytes = 0;

    Result<void> add(const SpirvModule& words) {
        GOBO_TRY(cost::Words bare, spirv::without_names(words));
        const std::size_t size = bare.size() * sizeof(bare[0]);
        if (distinct.insert(std::move(bare)).second) bytes += size;
        return {};
    }
};

}  // namespace

Result<Outcome> compare_specialized(const World& world, const CostCommandOptions& options,
                                    const std::vector<cost::Chip>& chips) {
    if (options.names.size() != 1)
        return fail(Fault::usage, "--specialized goes with one family",
                    "name it: gobo cost lit --specialized --gpu "
                    "navi21");
    struct Side {
        Composition composition;
        Validated validated;
        Modules modules;
    };
    if (!options.dialect.empty() && options.dialect != "vulkan")
        return fail(Fault::usage,
                    fmt::format("--specialized does not compare in --dialect {}", options.dialect),
                    "leave --dialect out, or name vulkan");
    const auto compiled = [&](const std::string& dialect, Counts counts) -> Result<Side> {
        GOBO_TRY(Subject subject, load_subject(world, options.names, {}, dialect, &options, counts));
        if (!std::ranges::all_of(subject.composition.permutations, is_costed, &Permutation::stages))
            GOBO_TRY_DO(
                refuse_other_stages(subject.family.family, subject.composition, "gobo cost compiles", true));
        Side side;
        GOBO_TRY(side.validated, compile(world, subject, {.keep_spirv = true}));
        for (const ValidatedStage& stage : side.validated.stages) GOBO_TRY_DO(side.modules.add(stage.spirv));
        side.composition = subject.composition;
        return side;
    };
    GOBO_TRY(const LoadedFamily family, load_family(world, options.names.front()));
    const bool is_vulkan = !options.dialect.empty();
    GOBO_TRY(const Side literal, compiled(is_vulkan ? "vulkan" : "450", Counts::literal));
    GOBO_TRY(const Side specialized, compiled(is_vulkan ? "vulkan" : "gl_spirv", Counts::specialized));
    // Of each permutation that has such counts the literal pipeline, then the specialised one.
    std::vector<cost::Pipeline> pipelines;
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < literal.composition.permutations.size(); ++i) {
        const Permutation& counted = specialized.composition.permutations[i];
        if (counted.specialized.empty()) continue;
        keys.push_back(key_text(family.family, counted.key));
        for (const Side* side : {&literal, &specialized}) {
            GOBO_TRY(cost::Pipeline pipeline,
                     pipeline_of(side->composition, side->validated, side->composition.permutations[i]));
            pipelines.push_back(std::move(pipeline));
        }
    }
    std::string text = fmt::format(
        "{} keys, of which {} have specialised counts\n"
        "{} modules of {} bytes instead of {} of {}\n",
        literal.composition.permutations.size(), keys.size(), specialized.modules.distinct.size(),
        specialized.modules.bytes, literal.modules.distinct.size(), literal.modules.bytes);
    Diagnostics diagnostics;
    const auto answers =
        cost::compile_on_chips(world.disk, chips, pipelines, compile_options(options, world));
    for (std::size_t chip = 0; chip < chips.size(); ++chip) {
        if (!answers[chip]) {
            append(diagnostics, answers[chip].error());
            continue;
        }
        std::size_t same = 0;
        std::size_t stages = 0;
        std::string others;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const auto& plain = answers[chip]->pipelines[2 * i];
            const auto& counted = answers[chip]->pipelines[2 * i + 1];
            for (const auto* answer : {&plain, &counted})
                if (!*answer)
                    append(diagnostics, report_failure(world, options, chips[chip],
                                                       pipelines[2 * i + (answer == &plain ? 0 : 1)], keys[i],
                                                       answer->error()));
            if (!plain || !counted) continue;
            for (std::size_t stage = 0; stage < std::min(plain->size(), counted->size()); ++stage) {
                ++stages;
                if ((*plain)[stage].assembly == (*counted)[stage].assembly)
                    ++same;
                else
                    others += fmt::format("  {} stage of '{}'\n", (*plain)[stage].stage, keys[i]);
            }
        }
        text += fmt::format("{}: {} of {} stages have the assembly of the literal counts ({})\n{}",
                            chips[chip].name, same, stages, answers[chip]->driver, others);
    }
    return Outcome{std::move(text), std::move(diagnostics)};
}

}  // namespace gobo
