#include "cost_support.hpp"

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "validate/validate.hpp"

namespace gobo::cost {

Result<Pipeline> pipeline_of(const Family& family, const Composition& composition) {
    const Validated validated = validate(family, composition, {.keep_spirv = true});
    EXPECT_EQ(exit_status(validated.diagnostics), 0) << to_text(validated.diagnostics.front());
    const Permutation& permutation = composition.permutations.front();
    std::vector<PipelineStage> stages;
    for (const StageNames& names : kStages)
        if (const int number = permutation.stages[names.kind]; number >= 0)
            stages.push_back({names.kind, validated.stage(number).spirv});
    if (composition.dialect != Dialect::vulkan) return cost::pipeline_of(std::move(stages));
    Result<Pipeline> pipeline = pipeline_of_vulkan(std::move(stages));
    for (const SpecializedCount& count : permutation.specialized)
        pipeline.value().constants.emplace_back(count.id, count.value);
    return pipeline;
}

Result<Pipeline> pipeline_of(const Sources& sources, Dialect dialect) {
    const MemoryFileSystem files(
        {{"a.vert", sources.vertex}, {"a.frag", sources.fragment}, {"a.comp", sources.compute}});
    SearchPath search;
    const std::vector<std::string> names = sources.compute.empty()
                                               ? std::vector<std::string>{"a.vert", "a.frag"}
                                               : std::vector<std::string>{"a.comp"};
    const Family family = family_of_files(names, files, search).value();
    return pipeline_of(family, compose(family, {Key{}}, search, dialect).value());
}

std::vector<Chip> chips_of(const std::vector<std::string>& names) {
    return chips_named(names).value();
}

std::vector<Result<ChipAnswers>> compile(const std::vector<Chip>& chips,
                                         const std::vector<Pipeline>& pipelines, CompileOptions options) {
    options.program = GOBO_LAB;
    return compile_on_chips(DiskFileSystem(), chips, pipelines, options);
}

}  // namespace gobo::cost
