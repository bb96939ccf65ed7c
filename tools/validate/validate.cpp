#include "validate/validate.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>

#include "core/parallel.hpp"
#include "family/key.hpp"
#include "reflect/interface.hpp"
#include "validate/glslang_stage.hpp"
#include "validate/link_rules.hpp"

namespace gobo {
namespace {

/// A stage's way through glslang. Parsed by the first program that needs it, dropped by the last: so no more
/// stages are alive than threads and stages that are shared.
struct Job {
    std::mutex mutex;
    std::unique_ptr<GlslangStage> glslang;
    std::atomic<int> programs_left = 0;
    bool places_vertices = false;  ///< in some program no stage follows that places them anew
    bool is_parsed = false;
    bool is_fine = false;
    Diagnostics diagnostics;
};

void append(Diagnostics& all, const Diagnostics& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// What SPIRV-Tools' validator says of a module under OpenGL 4.5's rules, as a second opinion on what glslang
/// made; empty where it is valid.
Diagnostics spirv_val(const SpirvModule& module, const Place& place) {
    Diagnostics found;
    const auto add = [&](std::string message) {
        append(found, fail(place, "", std::move(message)).value());
        found.back().fault = Fault::internal;
    };
    spvtools::SpirvTools tools(SPV_ENV_OPENGL_4_5);
    tools.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t& position, const char* message) {
            if (level <= SPV_MSG_ERROR)
                add(fmt::format("spirv-val: {} (instruction {})", message, position.index));
        });
    if (!tools.Validate(module) && found.empty()) add("spirv-val refuses the module without saying why");
    return found;
}

class Validator {
  public:
    Validator(const Composition& composition, const ValidateOptions& options)
        : composition_(composition), options_(options), jobs_(composition.stages.size()) {
        validated_.stages.resize(composition.stages.size());
        for (const Permutation& permutation : composition.permutations) {
            if (!numbers_.try_emplace(permutation.stages, programs_.size()).second) continue;
            std::vector<int>& program = programs_.emplace_back();
            int last = -1;  // before the rasteriser
            for (const StageNames& stage : kStages) {
                const int number = permutation.stages[stage.kind];
                if (number < 0) continue;
                program.push_back(number);
                ++job(number).programs_left;
                if (stage.kind < StageKind::fragment && stage.kind != StageKind::tess_control) last = number;
            }
            if (last >= 0) job(last).places_vertices = true;
        }
        of_programs_.resize(programs_.size());
    }

    /// Works off all programs by several threads.
    Validated run(const Family& family) {
        if (!programs_.empty()) {
            validate_program(0);  // alone: it builds glslang's tables for the version, once
            parallel_for(options_.jobs, programs_.size() - 1,
                         [&](std::size_t i) { validate_program(i + 1); });
        }
        parallel_for(options_.jobs, programs_.size(), [&](std::size_t i) { check_program(i); });
        DiagnosticGroups groups(family);
        for (const Permutation& permutation : composition_.permutations)
            for (const Diagnostic& diagnostic : diagnostics_of(permutation))
                groups.add(diagnostic, permutation.key);
        validated_.diagnostics = groups.result();
        return std::move(validated_);
    }

  private:
    Job& job(int stage) { return jobs_[static_cast<std::size_t>(stage)]; }

    /// What is wrong with a permutation's stages, or else with the program.
    [[nodiscard]] Diagnostics diagnostics_of(const Permutation& permutation) {
        const std::size_t index = numbers_.at(permutation.stages);
        Diagnostics all;
        for (const int stage : programs_[index]) append(all, job(stage).diagnostics);
        if (exit_status(all) == 0) append(all, of_programs_[index]);
        return all;
    }

    /// The rules that glslang forgets. Where they find why a program does not link they say it with both
    /// places, so what glslang said goes.
    void check_program(std::size_t index) {
        std::vector<StageView> views;
        for (const int stage : programs_[index]) {
            if (!job(stage).is_fine) return;
            views.push_back(
                {composition_.stage(stage).kind, validated_.stage(stage).interface, pieces_of(stage)});
        }
        if (views.empty()) return;
        Diagnostics& all = of_programs_[index];
        const Diagnostics found = check_link(views);
        if (exit_status(found) != 0) all.clear();
        append(all, found);
        if (exit_status(all) == 0) append(all, check_limits(views, composition_.dialect));
    }

    [[nodiscard]] std::vector<const Piece*> pieces_of(int stage) const {
        std::vector<const Piece*> pieces;
        for (const int piece : composition_.stage(stage).pieces) pieces.push_back(&composition_.piece(piece));
        return pieces;
    }
    [[nodiscard]] Place template_of(int stage) const { return {pieces_of(stage).back()->path, 0, 0}; }

    void validate_program(std::size_t index) {
        std::vector<int> stages = programs_[index];
        bool are_parsed = true;
        for (const int stage : stages) are_parsed = is_parsed(stage) && are_parsed;
        if (are_parsed && stages.size() > 1) {
            std::vector<GlslangStage*> parsed;
            for (const int stage : stages) parsed.push_back(job(stage).glslang.get());
            // Locked in the same order by every thread.
            std::ranges::sort(stages);
            std::vector<std::unique_lock<std::mutex>> locks;
            for (const int stage : stages) locks.emplace_back(job(stage).mutex);
            of_programs_[index] = link(parsed);
            // glslang keeps a failed link's errors in the stages, which other programs may share.
            if (exit_status(of_programs_[index]) != 0)
                for (GlslangStage* stage : parsed) stage->parse();
        }
        for (const int stage : programs_[index]) release(stage);
    }

    bool is_parsed(int stage) {
        Job& at = job(stage);
        const std::scoped_lock lock(at.mutex);
        if (std::exchange(at.is_parsed, true)) return at.is_fine;
        at.glslang = std::make_unique<GlslangStage>(composition_.stage(stage).kind, pieces_of(stage));
        at.diagnostics = at.glslang->parse();
        return at.is_fine = exit_status(at.diagnostics) == 0;
    }

    /// The last program of a stage makes its SPIR-V: glslang assigns locations then, which would disturb
    /// later links.
    void release(int stage) {
        Job& at = job(stage);
        if (--at.programs_left > 0) return;
        const std::scoped_lock lock(at.mutex);
        if (at.is_fine) generate(stage, at);
        at.glslang.reset();
    }

    void generate(int stage, Job& at) {
        Result<ValidatedStage> generated =
            at.glslang->generate(options_.debug_information, at.places_vertices);
        if (!generated) {
            append(at.diagnostics, generated.error());
            at.is_fine = false;
            return;
        }
        append(at.diagnostics, generated->diagnostics);
        if (options_.spirv_val) append(at.diagnostics, spirv_val(generated->spirv, template_of(stage)));
        if (!options_.keep_spirv) generated->spirv = {};
        const auto state = [&](auto& list) {
            for (auto& bound : list) {
                const auto stated = composition_.stated_bindings.find(bound.name);
                if (bound.binding < 0 && stated != composition_.stated_bindings.end())
                    bound.binding = stated->second;
            }
        };
        state(generated->interface.blocks);
        state(generated->interface.samplers);
        validated_.stages[static_cast<std::size_t>(stage)] = std::move(*generated);
    }

    const Composition& composition_;
    const ValidateOptions& options_;
    /// The distinct ones in the order in which the permutations first need them, their stages in that of the
    /// pipeline.
    std::vector<std::vector<int>> programs_;
    std::map<StageNumbers, std::size_t> numbers_;
    std::vector<Diagnostics> of_programs_;
    std::vector<Job> jobs_;
    Validated validated_;
};

}  // namespace

Validated validate(const Family& family, const Composition& composition, const ValidateOptions& options) {
    return Validator(composition, options).run(family);
}

Interface interface_of(const Validated& validated, const Permutation& permutation) {
    std::vector<Interface> stages;
    for (const int stage : permutation.stages.values)
        if (stage >= 0) stages.push_back(validated.stage(stage).interface);
    return merge(std::move(stages));
}

}  // namespace gobo
