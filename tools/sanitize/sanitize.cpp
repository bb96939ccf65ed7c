#include "sanitize/sanitize.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <string_view>
#include <thread>
#include <tuple>

#include <fmt/format.h>

#include "common/text.hpp"
#include "evaluate/instruction_table.hpp"
#include "family/key.hpp"
#include "sanitize/hard_inputs.hpp"
#include "sanitize/trap_observer.hpp"

namespace gobo::sanitize {
namespace {

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back(run);
    run();
}

/// The operation that last stores to the output; nothing where none does.
std::optional<std::uint32_t> last_store(const evaluate::Program& program, const evaluate::Port& port) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
        const evaluate::Slice& to = program.infos[at].result;
        const bool is_within = to.slot < port.slot + port.components && port.slot < to.slot + to.count;
        if (row.name == "Store" && is_within) found = at;
    }
    return found;
}

/// Outputs of OpenGL's own may be left alone, and vertex outputs that the fragment stage does not read.
bool must_be_written(const evaluate::Program& program, const evaluate::Port& port) {
    if (last_store(program, port)) return true;
    return program.is_fragment && !port.name.starts_with("gl_");
}

/// One finding for each output that some invocation, not discarded, leaves unwritten.
std::vector<Finding> unwritten_outputs(const evaluate::Program& program,
                                       const evaluate::Invocations& invocations,
                                       const evaluate::Outputs& outputs, const TrapObserver& observer) {
    std::map<std::size_t, Finding> findings;
    for (const Unwritten& unwritten : observer.unwritten()) {
        const evaluate::Port& port = program.outputs[unwritten.output];
        if (!must_be_written(program, port)) continue;
        for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
            const std::size_t index = unwritten.first_invocation + lane;
            if ((unwritten.lanes >> lane & 1U) == 0 || index >= invocations.count || outputs.discarded[index])
                continue;
            Finding& finding = findings[unwritten.output];
            if (finding.points++ > 0) continue;
            finding.message = fmt::format("the output '{}' is not written on some path", port.name);
            if (const auto store = last_store(program, port)) finding.place = program.place_of(*store);
            finding.point = point_of(program, invocations, index);
        }
    }
    std::vector<Finding> result;
    for (auto& [output, finding] : findings) result.push_back(std::move(finding));
    return result;
}

using Signature = std::tuple<std::string, int, std::string>;

Signature signature_of(const Finding& finding) {
    return {finding.place.file, finding.place.line, finding.message};
}

/// Findings of the same place and kind become one; the first keeps its example.
void merge(std::map<Signature, Finding>& into, std::vector<Finding> findings) {
    for (Finding& finding : findings) {
        const auto [found, is_new] = into.try_emplace(signature_of(finding), finding);
        if (!is_new) found->second.points += finding.points;
    }
}

/// What one stage gives.
struct StageReport {
    std::map<Signature, Finding> findings;
    Diagnostics diagnostics;
    std::uint64_t points = 0;
};

/// Inputs are made and run in portions, so that they stay in the cache.
constexpr std::size_t kPortion = 1024;

/// Adds `options.points` points from `seed` on to the stage's report.
void sanitize_stage(const SpirvModule& spirv, StageKind kind, const std::vector<Domain>& domains,
                    const SanitizeOptions& options, std::uint64_t seed, StageReport& report) {
    const Result<evaluate::Program> program = evaluate::decode(spirv);
    if (!program) {
        report.diagnostics = program.error();
        return;
    }
    for (std::size_t done = 0; done < options.points; done += kPortion) {
        const std::size_t count = std::min(kPortion, options.points - done);
        const evaluate::Invocations invocations =
            hard_inputs(*program, domains, count, seed + done / kPortion);
        for (const Machine machine : options.machines) {
            Result<std::vector<Finding>> found = find_traps(*program, invocations, machine);
            if (!found) {
                report.diagnostics = found.error();
                return;
            }
            for (Finding& finding : *found) finding.stage = kind;
            merge(report.findings, std::move(*found));
            report.points += count;
        }
    }
}

/// What stages share is reported once.
void add(SanitizeReport& report, const StageReport& stage, const std::vector<std::size_t>& permutations) {
    report.points += stage.points;
    for (const auto& [signature, finding] : stage.findings) {
        const auto shared = std::find_if(
            report.findings.begin(), report.findings.end(),
            [&](const SharedFinding& other) { return signature_of(other.finding) == signature; });
        if (shared == report.findings.end()) {
            report.findings.push_back({finding, permutations});
            continue;
        }
        shared->finding.points += finding.points;
        std::vector<std::size_t>& all = shared->permutations;
        all.insert(all.end(), permutations.begin(), permutations.end());
    }
}

/// Every stage once, and again from other seeds as long as there is time.
std::vector<StageReport> sanitize_stages(const Family& family, const Composition& composition,
                                         const Validated& validated, const SanitizeOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(options.minutes);
    const std::uint64_t seeds_of_round = (options.points + kPortion - 1) / kPortion;
    std::vector<StageReport> stages(composition.stages.size());
    std::uint64_t seed = options.seed;
    do {
        for_each_index(stages.size(), options.jobs, [&](std::size_t i) {
            sanitize_stage(validated.stages[i].spirv, composition.stages[i].kind, family.domains, options,
                           seed, stages[i]);
        });
        seed += seeds_of_round;
    } while (Clock::now() < end && options.points > 0);
    return stages;
}

std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage) {
    std::vector<std::size_t> permutations;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        if (permutation.vertex == static_cast<int>(stage) || permutation.fragment == static_cast<int>(stage))
            permutations.push_back(i);
    }
    return permutations;
}

}  // namespace

Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                        const evaluate::Invocations& invocations, Machine machine) {
    TrapObserver observer(program);
    const Result<evaluate::Outputs> outputs =
        evaluate::run<float>(program, invocations, options_of(machine), &observer);
    if (!outputs) return tl::unexpected(outputs.error());
    observer.finish();
    std::vector<Finding> findings = unwritten_outputs(program, invocations, *outputs, observer);
    for (const auto& [where, hit] : observer.hits()) {
        Finding finding;
        finding.place = program.place_of(where.first);
        finding.message = where.second;
        finding.operation = hit.operation;
        finding.machine = machine;
        finding.point = point_of(program, invocations, hit.first);
        finding.points = hit.invocations;
        findings.push_back(std::move(finding));
    }
    return findings;
}

SanitizeReport sanitize(const Family& family, const Composition& composition, const Validated& validated,
                        const SanitizeOptions& options) {
    const std::vector<StageReport> stages = sanitize_stages(family, composition, validated, options);
    SanitizeReport report;
    report.stages = stages.size();
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const std::vector<std::size_t> permutations = permutations_of(composition, i);
        for (Diagnostic error : stages[i].diagnostics) {
            if (!permutations.empty())
                error.subject = key_text(family, composition.permutations[permutations.front()].key);
            report.diagnostics.push_back(std::move(error));
        }
        add(report, stages[i], permutations);
    }
    std::sort(report.findings.begin(), report.findings.end(),
              [](const SharedFinding& a, const SharedFinding& b) {
                  return signature_of(a.finding) < signature_of(b.finding);
              });
    return report;
}

}  // namespace gobo::sanitize
