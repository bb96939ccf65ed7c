#include "lab/sanitize/precision_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "lab/sanitize/stages.hpp"

namespace gobo::sanitize {
namespace {

using Json = nlohmann::ordered_json;

struct Line {
    const StagePrecision* stage;
    const OutputLoss* loss;
};

/// The largest error first; the rest of the order only keeps it the same.
std::vector<Line> sorted_lines(const std::vector<StagePrecision>& stages) {
    std::vector<Line> lines;
    for (const StagePrecision& stage : stages)
        for (const OutputLoss& loss : stage.report.outputs) lines.push_back({&stage, &loss});
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line& a, const Line& b) { return a.loss->error > b.loss->error; });
    return lines;
}

double share_of(const Contribution& contribution, const OutputLoss& loss) {
    return contribution.change / loss.all_contributions;
}

std::string component_text(const OutputLoss& loss) {
    return fmt::format("{}[{}]", loss.output, loss.component);
}

/// "fog/linear.glsl:15 FSub, 87 %"; a loss that no single rounding makes has no place.
std::string place_text(const OutputLoss& loss) {
    if (loss.contributions.empty()) return "-";
    const Contribution& most = loss.contributions.front();
    return fmt::format("{}:{} {}, {:.0f} %", most.place.file, most.place.line, most.operation,
                       100 * share_of(most, loss));
}

std::string keys_text(const StagePrecision& stage) {
    if (stage.keys.empty()) return "";
    const std::string first = stage.keys.front().empty() ? "default" : stage.keys.front();
    return stage.keys.size() == 1 ? first : fmt::format("{} and {} more", first, stage.keys.size() - 1);
}

Json json_of(const OutputLoss& loss) {
    Json contributions = Json::array();
    for (const Contribution& one : loss.contributions)
        contributions.push_back({{"file", one.place.file},
                                 {"line", one.place.line},
                                 {"operation", one.operation},
                                 {"change", one.change},
                                 {"share", share_of(one, loss)}});
    return contributions;
}

}  // namespace

Result<std::vector<StagePrecision>> measure_precision(const Family& family, const Composition& composition,
                                                      const Validated& validated,
                                                      const SanitizeOptions& options) {
    std::vector<StagePrecision> stages(composition.stages.size());
    std::vector<Diagnostics> errors(stages.size());
    for_each_index(stages.size(), options.jobs, [&](std::size_t i) {
        stages[i].stage = composition.stages[i].kind;
        for (const std::size_t permutation : permutations_of(composition, i))
            stages[i].keys.push_back(key_text(family, composition.permutations[permutation].key));
        const Result<evaluate::Program> program = evaluate::decode(validated.stages[i].spirv);
        if (!program) {
            errors[i] = program.error();
            return;
        }
        const InputSpace space = input_space_of(*program, family.domains);
        Result<PrecisionReport> report = measure_precision(*program, space, options.points, options.seed);
        if (report)
            stages[i].report = std::move(*report);
        else
            errors[i] = report.error();
    });
    for (Diagnostics& error : errors)
        if (!error.empty()) return tl::unexpected(std::move(error));
    return stages;
}

std::string precision_text(const std::vector<StagePrecision>& stages) {
    std::string text = fmt::format("{:<10} {:<14} {:<14} {:<18} {:<52} {}\n", "error", "fp32", "fp64",
                                   "output", "most of it from", "keys");
    for (const auto& [stage, loss] : sorted_lines(stages))
        text += fmt::format("{:<10.3g} {:<14.8g} {:<14.8g} {:<18} {:<52} {}\n", loss->error, loss->fp32,
                            loss->fp64, component_text(*loss), place_text(*loss), keys_text(*stage));
    std::uint64_t points = 0;
    std::uint64_t otherwise = 0;
    for (const StagePrecision& stage : stages) {
        points += stage.report.points;
        otherwise += stage.report.decided_otherwise;
    }
    return text + fmt::format("{} points, {} of them left out: fp32 took another side of a comparison\n",
                              points, otherwise);
}

std::string precision_json(const std::vector<StagePrecision>& stages) {
    Json outputs = Json::array();
    for (const auto& [stage, loss] : sorted_lines(stages))
        outputs.push_back({{"keys", stage->keys},
                           {"stage", name_of(stage->stage)},
                           {"output", loss->output},
                           {"component", loss->component},
                           {"error", loss->error},
                           {"fp32", loss->fp32},
                           {"fp64", loss->fp64},
                           {"contributions", json_of(*loss)},
                           {"inputs", loss->point.inputs},
                           {"uniforms", loss->point.uniforms},
                           {"samplers", loss->point.samplers}});
    return Json{{"outputs", outputs}}.dump(2) + "\n";
}

}  // namespace gobo::sanitize
