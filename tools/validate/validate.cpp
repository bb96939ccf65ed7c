#include "validate/validate.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/child_processes.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "reflect/interface.hpp"
#include "validate/batch.hpp"
#include "validate/glslang_log.hpp"
#include "validate/glslang_stage.hpp"
#include "validate/known_results.hpp"
#include "validate/link_rules.hpp"
#include "validate/old_versions.hpp"

namespace gobo {
namespace {

/// What is known of a stage beside its ValidatedStage.
struct OfStage {
    bool is_fine = false;
    Diagnostics diagnostics = {};
};

/// glslang builds its tables for a version when it first meets it: once, before there are threads or child
/// processes.
void build_tables(const Composition& composition) {
    std::set<std::string> versions;
    for (const Stage& stage : composition.stages) {
        const std::string& prologue = composition.piece(stage.pieces.front()).text;
        versions.insert(prologue.substr(0, prologue.find('\n') + 1));
    }
    for (const std::string& version : versions) {
        const Piece piece{"", "", version + "void main() {}\n"};
        ReadPieces read;
        GlslangStage(StageKind::vertex, {&piece}, composition.dialect, read).parse();
    }
}

std::string reason_text(Death death, const ChildLimits& limits) {
    if (death == Death::crash || death == Death::exit) return "glslang crashes on";
    if (death == Death::killed) return "glslang was killed, perhaps for want of memory, on";
    if (death == Death::time)
        return fmt::format("glslang takes more than {} s of processor time, or {} s by the clock, for",
                           limits.processor_seconds, limits.wall_seconds);
    return fmt::format("glslang takes more than {} GB of memory for", limits.memory >> 30);
}

class Validator {
  public:
    Validator(const Composition& composition, const ValidateOptions& options)
        : composition_(composition), options_(options), of_stages_(composition.stages.size()) {
        for (const Permutation& permutation : composition.permutations) {
            if (!numbers_.try_emplace(permutation.stages, programs_.size()).second) continue;
            Program& program = programs_.emplace_back();
            for (const int number : permutation.stages.values)
                if (number >= 0) program.push_back(number);
        }
        of_programs_.resize(programs_.size());
        validated_.stages.resize(composition.stages.size());
        placing_ = placing_stages(composition, programs_);
        if (options.cache != nullptr) known_.emplace(composition, programs_, placing_, options);
        choose_work();
        batches_ = batches_of(work_, options.jobs);
        for (Batch& batch : batches_)
            std::erase_if(batch.own, [&](int stage) { return is_known_[static_cast<std::size_t>(stage)]; });
    }

    /// Works off all programs.
    Validated run(const Family& family) {
        if (!batches_.empty()) compile();
        if (known_) keep_results();
        state_bindings();
        parallel_for(options_.jobs, programs_.size(), [&](std::size_t i) { check_program(i, family); });
        DiagnosticGroups groups(family);
        for (std::size_t i = 0; i < composition_.permutations.size(); ++i) {
            const Permutation& permutation = composition_.permutations[i];
            const Diagnostics found = diagnostics_of(permutation);
            for (const Diagnostic& diagnostic : found) groups.add(diagnostic, permutation.key);
            if (exit_status(found) != 0) validated_.failed.insert(i);
        }
        validated_.diagnostics = groups.result();
        return std::move(validated_);
    }

  private:
    /// Takes what is known, and leaves to be done what is not: programs that must be linked, and stages
    /// alone.
    void choose_work() {
        is_known_.assign(composition_.stages.size(), false);
        is_linked_.assign(programs_.size(), false);
        if (known_)
            for (std::size_t stage = 0; stage < is_known_.size(); ++stage)
                if (auto result = known_->stage(static_cast<int>(stage))) {
                    take(*std::move(result));
                    is_known_[stage] = true;
                }
        std::set<int> alone;
        for (std::size_t i = 0; i < programs_.size(); ++i) {
            const auto is_unknown = [&](int stage) { return !is_known_[static_cast<std::size_t>(stage)]; };
            const bool can_link = std::ranges::all_of(
                programs_[i], [&](int stage) { return is_unknown(stage) || of_stage(stage).is_fine; });
            if (known_ && programs_[i].size() > 1)
                if (std::optional<Diagnostics> found = known_->program(i)) {
                    of_programs_[i] = *std::move(found);
                    is_linked_[i] = true;
                }
            if (!is_linked_[i] && can_link && programs_[i].size() > 1) {
                add_work(programs_[i], i);
            } else {
                for (const int stage : programs_[i])
                    if (is_unknown(stage)) alone.insert(stage);
            }
        }
        for (const int stage : alone) add_work({stage}, programs_.size());
        validated_.compiled = static_cast<std::size_t>(std::ranges::count(is_known_, false));
    }

    void add_work(Program program, std::size_t number) {
        work_.push_back(std::move(program));
        numbers_of_work_.push_back(number);
    }

    void compile() {
        build_tables(composition_);
        std::vector<std::size_t> left(batches_.size());
        std::iota(left.begin(), left.end(), std::size_t{0});
        if (options_.child_processes) left = work_off_in_children();
        work_off_in_threads(left);
    }

    void keep_results() {
        const auto may_change = [](const Diagnostics& found) {
            return exit_status(found) > 1 || std::ranges::any_of(found, is_of_stopped_glslang);
        };
        for (int stage = 0; stage < static_cast<int>(is_known_.size()); ++stage) {
            const OfStage& found = of_stage(stage);
            if (!is_known_[static_cast<std::size_t>(stage)] && !may_change(found.diagnostics))
                known_->keep(
                    BatchResult::OfStage{stage, found.is_fine, found.diagnostics, validated_.stage(stage)});
        }
        for (std::size_t i = 0; i < work_.size(); ++i) {
            const std::size_t program = numbers_of_work_[i];
            if (program == programs_.size() || may_change(of_programs_[program])) continue;
            const auto is_fine = [&](int stage) { return of_stage(stage).is_fine; };
            if (std::ranges::all_of(work_[i], is_fine))
                known_->keep(BatchResult::OfProgram{program, of_programs_[program]});
        }
        known_->keep_links();
    }

    /// Puts in the bindings that pieces state where their dialect's text cannot carry them.
    void state_bindings() {
        const auto state = [&](auto& list) {
            for (auto& bound : list) {
                const auto stated = composition_.stated_bindings.find(bound.name);
                if (bound.binding < 0 && stated != composition_.stated_bindings.end())
                    bound.binding = stated->second;
            }
        };
        for (ValidatedStage& stage : validated_.stages) {
            state(stage.interface.blocks);
            state(stage.interface.samplers);
        }
    }

    void work_off_in_threads(const std::vector<std::size_t>& batches) {
        std::vector<BatchResult> results(batches.size());
        const std::size_t threads = std::min(static_cast<std::size_t>(options_.jobs), batches.size());
        std::atomic<std::size_t> next = 0;
        parallel_for(options_.jobs, threads, [&](std::size_t) {
            BatchWorker worker(composition_, work_, placing_, options_);
            Note note = 0;
            for (std::size_t i = next++; i < batches.size(); i = next++)
                results[i] = worker.work_off(batches_[batches[i]], given_up_, note);
        });
        for (BatchResult& result : results) take(std::move(result));
    }

    /// The batches that are left where no child process can be started.
    std::vector<std::size_t> work_off_in_children() {
        BatchWorker worker(composition_, work_, placing_, options_);  // each child goes on with its copy
        const ChildWork work{
            [&](std::size_t batch, Note& note) {
                return bytes_of(worker.work_off(batches_[batch], given_up_, note));
            },
            [&](std::size_t, std::string_view bytes) {
                std::optional<BatchResult> result = result_of(bytes);
                return result && take(*std::move(result));
            },
            [&](std::size_t batch, int note, Death death) { return give_up(batch, note, death); }};
        return run_in_children(options_.jobs, batches_.size(), work, limits_);
    }

    /// Whether all the numbers are known, which a child process may have spoilt.
    bool take(BatchResult result) {
        const auto is_known = [](auto number, const auto& list) {
            return static_cast<std::size_t>(number) < list.size();
        };
        for (const BatchResult::OfStage& stage : result.stages)
            if (!is_known(stage.stage, of_stages_)) return false;
        for (const BatchResult::OfProgram& program : result.programs)
            if (!is_known(program.program, work_) || is_alone(program.program)) return false;
        for (BatchResult::OfStage& stage : result.stages) take(std::move(stage));
        for (BatchResult::OfProgram& program : result.programs)
            of_programs_[numbers_of_work_[program.program]] = std::move(program.diagnostics);
        return true;
    }

    void take(BatchResult::OfStage stage) {
        validated_.stages[static_cast<std::size_t>(stage.stage)] = std::move(stage.validated);
        of_stage(stage.stage) = {stage.is_fine, std::move(stage.diagnostics)};
    }

    /// Whether the work is to compile a stage, not to link a program.
    [[nodiscard]] bool is_alone(std::size_t work) const { return numbers_of_work_[work] == programs_.size(); }

    /// Blames the stage or program that a child process died of. Whether the batch is worth another try.
    bool give_up(std::size_t batch, int note, Death death) {
        constexpr const char* help = "simplify its longest expressions, its arrays, structs and macros";
        const std::string reason = reason_text(death, limits_);
        if (note > 0) {
            const int stage = note - 1;
            const std::string what =
                fmt::format("{} the {} stage", reason, name_of(composition_.stage(stage).kind));
            Diagnostics errors = fail(template_of(stage), "", what, help).value();
            if (death == Death::crash) explain_crash(errors.front(), pieces_of(composition_, stage));
            const bool is_new = given_up_.try_emplace(note, std::move(errors)).second;
            if (is_new) keep_stopped(stage);
            return is_new;
        }
        if (note < 0) {
            const auto program = static_cast<std::size_t>(-1 - note);
            const std::string what = fmt::format("{} linking the stages", reason);
            const bool is_new =
                given_up_.try_emplace(note, fail(template_of(work_[program].back()), "", what, help).value())
                    .second;
            for (const int stage : work_[program])
                if (is_new) keep_stopped(stage);
            return is_new;
        }
        const Diagnostics fault = fail(Fault::internal, "a child process died between two stages").value();
        for (const int stage : batches_[batch].own) of_stage(stage).diagnostics = fault;
        for (const std::size_t work : batches_[batch].programs)
            if (!is_alone(work)) of_programs_[numbers_of_work_[work]] = fault;
        return false;
    }

    void keep_stopped(int stage) {
        const Stage& stopped = composition_.stage(stage);
        validated_.stopped.push_back({stopped.kind, source_of(composition_, stopped)});
    }

    [[nodiscard]] OfStage& of_stage(int stage) { return of_stages_[static_cast<std::size_t>(stage)]; }

    /// What is wrong with a permutation's stages, or else with the program.
    [[nodiscard]] Diagnostics diagnostics_of(const Permutation& permutation) {
        const std::size_t index = numbers_.at(permutation.stages);
        Diagnostics all;
        for (const int stage : programs_[index]) append(all, of_stage(stage).diagnostics);
        if (exit_status(all) == 0) append(all, of_programs_[index]);
        return all;
    }

    /// The rules that glslang forgets. Where they find why a program does not link they say it with both
    /// places, so what glslang said goes.
    void check_program(std::size_t index, const Family& family) {
        std::vector<StageView> views;
        for (const int stage : programs_[index]) {
            if (!of_stage(stage).is_fine) return;
            views.push_back({composition_.stage(stage).kind, validated_.stage(stage).interface,
                             pieces_of(composition_, stage)});
        }
        if (views.empty()) return;
        Diagnostics& all = of_programs_[index];
        const bool is_vulkan = composition_.dialect == Dialect::vulkan;
        Diagnostics found = is_vulkan ? check_varyings(views, Api::vulkan) : check_link(views);
        if (is_vulkan) append(found, check_descriptors(views, family));
        if (exit_status(found) != 0) all.clear();
        append(all, found);
        if (is_spirv(composition_.dialect)) append(all, check_constants(views));
        if (exit_status(all) == 0) append(all, check_limits(views, composition_.dialect));
    }

    [[nodiscard]] Place template_of(int stage) const {
        return {pieces_of(composition_, stage).back()->path, 0, 0};
    }

    const Composition& composition_;
    const ValidateOptions& options_;
    const ChildLimits limits_{.wall_seconds = 120};
    /// The distinct ones, in the order in which the permutations first need them.
    std::vector<Program> programs_;
    std::map<StageNumbers, std::size_t> numbers_;
    std::set<int> placing_;
    std::optional<KnownResults> known_;
    std::vector<bool> is_known_;   ///< by stage, whether its result came from the cache
    std::vector<bool> is_linked_;  ///< by program
    /// What is not known: programs to be linked, and stages alone, which have the number past all programs.
    std::vector<Program> work_;
    std::vector<std::size_t> numbers_of_work_;
    std::vector<Batch> batches_;  ///< of the work
    GivenUp given_up_;
    std::vector<OfStage> of_stages_;
    std::vector<Diagnostics> of_programs_;
    Validated validated_;
};

}  // namespace

bool is_of_stopped_glslang(const Diagnostic& diagnostic) {
    return diagnostic.message.starts_with("glslang crashes on ") ||
           diagnostic.message.starts_with("glslang was killed, ") ||
           diagnostic.message.starts_with("glslang takes more than ");
}

Validated validate(const Family& family, const Composition& composition, const ValidateOptions& options) {
    Validated validated = Validator(composition, options).run(family);
    validated.diagnostics = with_version_missed(std::move(validated.diagnostics), family, composition);
    return validated;
}

Diagnostics same_programs(const Family& family, const Composition& composition, const Validated& validated) {
    // The stages by their SPIR-V, and the counts that are constants in them.
    using Executable = std::pair<PerStage<std::uint64_t>, std::map<int, int>>;
    const auto program_of = [&](const Permutation& permutation) {
        const auto hash = [&](int stage) { return stage < 0 ? 0 : validated.stage(stage).hash; };
        Executable program;
        for (const StageNames& stage : kStages)
            program.first[stage.kind] = hash(permutation.stages[stage.kind]);
        for (const int stage : permutation.stages.values) {
            if (stage < 0) continue;
            for (const SpecializationConstant& constant :
                 validated.stage(stage).interface.specialization_constants)
                for (const SpecializedCount& count : permutation.specialized)
                    if (count.id == constant.id) program.second[count.id] = count.value;
        }
        return program;
    };
    std::map<Executable, const Key*> first_of;
    std::map<Key, Executable> programs;
    std::string example;
    for (const Permutation& permutation : composition.permutations) {
        const auto program = program_of(permutation);
        programs.emplace(permutation.key, program);
        const auto [at, is_new] = first_of.try_emplace(program, &permutation.key);
        if (!is_new && example.empty())
            example = fmt::format("'{}' and '{}'", key_text(family, *at->second),
                                  key_text(family, permutation.key));
    }
    if (example.empty()) return {};
    std::vector<std::string> idle;
    for (std::size_t feature = 0; feature < family.features.size(); ++feature) {
        int same = 0;
        const bool matters = std::ranges::any_of(programs, [&](const auto& entry) {
            Key key = entry.first;
            if (std::exchange(key[feature], 0) == 0) return false;
            const auto without = programs.find(key);
            if (without == programs.end()) return false;
            same += without->second == entry.second ? 1 : 0;
            return without->second != entry.second;
        });
        if (!matters && same > 0) idle.push_back("'" + family.features[feature].name + "'");
    }
    Diagnostics warnings =
        fail({family.path, 0, 0}, "",
             fmt::format(
                 "the keys {} give the same program: {} of the {} keys are distinct{}", example,
                 first_of.size(), programs.size(),
                 idle.empty() ? "" : fmt::format(", and {} changes nothing in any key", join(idle, " or "))),
             "add a rule: when = \"...\" with default = [...] for the feature that cannot matter there")
            .value();
    warnings.front().severity = Severity::warning;
    return warnings;
}

Interface interface_of(const Validated& validated, const Permutation& permutation) {
    std::vector<Interface> stages;
    for (const int stage : permutation.stages.values)
        if (stage >= 0) stages.push_back(validated.stage(stage).interface);
    return merge(std::move(stages));
}

}  // namespace gobo
