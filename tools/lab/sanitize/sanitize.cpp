#include "lab/sanitize/sanitize.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/evaluate/functions.hpp"
#include "family/key.hpp"
#include "lab/sanitize/hard_inputs.hpp"
#include "lab/sanitize/input_range.hpp"
#include "lab/sanitize/stage_search.hpp"
#include "lab/sanitize/stages.hpp"

namespace gobo::sanitize {
namespace {

/// What one stage gives.
struct StageReport {
    std::unique_ptr<StageSearch> search;  ///< null where the stage cannot be evaluated
    Diagnostics diagnostics;
};

StageReport open_stage(const Family& family, const Composition& composition, const Validated& validated,
                       std::size_t stage, const SanitizeOptions& options) {
    StageReport report;
    Result<evaluate::Program> program = evaluate::decode(validated.stages[stage].spirv);
    if (!program) {
        report.diagnostics = program.error();
        return report;
    }
    const DepthPromise promise = depth_promise_of(validated.stages[stage].spirv);
    const std::vector<std::size_t> permutations = permutations_of(composition, stage);
    const Key key = permutations.empty() ? Key{} : composition.permutations[permutations.front()].key;
    report.search = std::make_unique<StageSearch>(family, key, composition.stages[stage].kind,
                                                  std::move(*program), promise, options.machines);
    if (options.guided > 0 || options.minutes > 0) report.search->guide_from(options.seed);
    return report;
}

/// Whether the stage can still be searched; otherwise its diagnostics say why not.
bool keep(StageReport& report, const Result<bool>& ran) {
    if (!ran) report.diagnostics = ran.error();
    return ran.has_value();
}

/// Calls run(first, count) for portion after portion of so many points.
void in_portions(StageReport& report, std::size_t points,
                 const std::function<Result<bool>(std::size_t, std::size_t)>& run) {
    if (!report.search || !report.diagnostics.empty()) return;
    for (std::size_t done = 0; done < points; done += kPortion)
        if (!keep(report, run(done, std::min(kPortion, points - done)))) return;
}

/// Hard points of each stage.
std::size_t points_of_stage(const SanitizeOptions& options, std::size_t stages) {
    if (options.total == 0 || stages == 0) return options.points;
    return (options.total + stages - 1) / stages;
}

void search(StageReport& report, const SanitizeOptions& options, std::size_t points) {
    in_portions(report, points, [&](std::size_t first, std::size_t count) {
        return report.search->run(
            hard_points(report.search->space(), count, options.seed + first / kPortion));
    });
}

void search_guided(StageReport& report, std::size_t points) {
    in_portions(report, points,
                [&](std::size_t, std::size_t count) { return report.search->run_guided(count); });
}

/// What stages share is reported once.
void add(SanitizeReport& report, const StageSearch& search, std::size_t stage,
         const std::vector<std::size_t>& permutations) {
    report.points += search.points();
    for (const auto& [signature, finding] : search.findings()) {
        const auto shared = std::find_if(
            report.findings.begin(), report.findings.end(),
            [&](const SharedFinding& other) { return signature_of(other.finding) == signature; });
        if (shared == report.findings.end()) {
            report.findings.push_back({finding, stage, permutations});
            continue;
        }
        shared->finding.points += finding.points;
        std::vector<std::size_t>& all = shared->permutations;
        all.insert(all.end(), permutations.begin(), permutations.end());
    }
}

/// Every stage once, and again with points made of what was reached as long as there is time.
std::vector<StageReport> sanitize_stages(const Family& family, const Composition& composition,
                                         const Validated& validated, const SanitizeOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(options.minutes);
    std::vector<StageReport> stages(composition.stages.size());
    for_each_index(stages.size(), options.jobs, [&](std::size_t i) {
        stages[i] = open_stage(family, composition, validated, i, options);
        search(stages[i], options, points_of_stage(options, stages.size()));
        search_guided(stages[i], options.guided);
    });
    while (Clock::now() < end)
        for_each_index(stages.size(), options.jobs, [&](std::size_t i) {
            if (Clock::now() < end) search_guided(stages[i], kPortion);
        });
    return stages;
}

/// Gives each finding that is reported a simpler input.
void simplify(SanitizeReport& report, std::vector<StageReport>& stages, int jobs) {
    for_each_index(stages.size(), jobs, [&](std::size_t stage) {
        for (SharedFinding& shared : report.findings)
            if (shared.stage == stage) shared.finding = stages[stage].search->simplified(shared.finding);
    });
}

}  // namespace

SanitizeReport sanitize(const Family& family, const Composition& composition, const Validated& validated,
                        const SanitizeOptions& options) {
    std::vector<StageReport> stages = sanitize_stages(family, composition, validated, options);
    SanitizeReport report;
    report.stages = stages.size();
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const std::vector<std::size_t> permutations = permutations_of(composition, i);
        for (Diagnostic error : stages[i].diagnostics) {
            if (!permutations.empty())
                error.subject = key_text(family, composition.permutations[permutations.front()].key);
            report.diagnostics.push_back(std::move(error));
        }
        if (stages[i].search) add(report, *stages[i].search, i, permutations);
    }
    simplify(report, stages, options.jobs);
    std::sort(report.findings.begin(), report.findings.end(),
              [](const SharedFinding& a, const SharedFinding& b) {
                  return signature_of(a.finding) < signature_of(b.finding);
              });
    return report;
}

Diagnostics domains_of_nothing(const std::vector<Domain>& domains, const Validated& validated) {
    std::set<std::string> names;
    for (const ValidatedStage& stage : validated.stages)
        if (const Result<evaluate::Program> program = evaluate::decode(stage.spirv))
            for (const auto* ports : {&program->inputs, &program->uniforms, &program->outputs})
                for (const evaluate::Port& port : *ports) names.insert(name_of_domain(port.name));
    Diagnostics errors;
    for (const Domain& domain : domains)
        if (!names.contains(domain.name))
            errors.push_back(evaluate::error_at(domain.place,
                                                fmt::format("no stage reads or writes '{}'", domain.name),
                                                suggestion(domain.name, {names.begin(), names.end()})));
    return errors;
}

}  // namespace gobo::sanitize
