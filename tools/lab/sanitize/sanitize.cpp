#include "lab/sanitize/sanitize.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/evaluate/functions.hpp"
#include "lab/sanitize/search.hpp"
#include "lab/verify/random_points.hpp"

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

/// Hard points of each stage.
std::size_t points_of_stage(const SanitizeOptions& options, std::size_t stages) {
    if (options.total == 0 || stages == 0) return options.points;
    return (options.total + stages - 1) / stages;
}

/// Runs so many points, portion after portion, as long as nothing fails.
void search(StageReport& report, std::size_t points,
            const std::function<Result<void>(StageSearch&, std::size_t first, std::size_t count)>& run) {
    for (std::size_t done = 0; done < points && report.search && report.diagnostics.empty(); done += kPortion)
        if (const auto ran = run(*report.search, done, std::min(kPortion, points - done)); !ran)
            report.diagnostics = ran.error();
}

void search_guided(StageReport& report, std::size_t points) {
    search(report, points,
           [](StageSearch& stage, std::size_t, std::size_t count) { return stage.run_guided(count); });
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
    parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
        stages[i] = open_stage(family, composition, validated, i, options);
        search(stages[i], points_of_stage(options, stages.size()),
               [&](StageSearch& stage, std::size_t first, std::size_t count) {
                   return stage.run(hard_points(stage.space(), count, options.seed + first / kPortion));
               });
        search_guided(stages[i], options.guided);
    });
    while (Clock::now() < end)
        parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
            if (Clock::now() < end) search_guided(stages[i], kPortion);
        });
    return stages;
}

}  // namespace

std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage) {
    std::vector<std::size_t> permutations;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        if (permutation.vertex == static_cast<int>(stage) || permutation.fragment == static_cast<int>(stage))
            permutations.push_back(i);
    }
    return permutations;
}

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
    parallel_for(options.jobs, stages.size(), [&](std::size_t stage) {
        for (SharedFinding& shared : report.findings)
            if (shared.stage == stage) shared.finding = stages[stage].search->simplified(shared.finding);
    });
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
                for (const evaluate::Port& port : *ports) names.insert(verify::without_subscripts(port.name));
    Diagnostics errors;
    for (const Domain& domain : domains)
        if (!names.contains(domain.name))
            errors.push_back(evaluate::error_at(domain.place,
                                                fmt::format("no stage reads or writes '{}'", domain.name),
                                                suggestion(domain.name, {names.begin(), names.end()})));
    return errors;
}

}  // namespace gobo::sanitize
