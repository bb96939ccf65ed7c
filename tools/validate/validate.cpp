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

/// A vertex and a fragment stage that some permutation puts together; -1 where it has none.
using Pair = std::pair<int, int>;

/// A stage's way through glslang. Parsed by the first pair that needs it, dropped by the last: so no more
/// stages are alive than threads and stages that are shared.
struct Job {
    std::mutex mutex;
    std::unique_ptr<GlslangStage> glslang;
    std::atomic<int> pairs_left = 0;
    bool is_parsed = false;
    bool is_fine = false;
    Diagnostics diagnostics;
};

void append(Diagnostics& all, const Diagnostics& more) {
    all.insert(all.end(), more.begin(), more.end());
}

Interface stage_interface(const Validated& validated, int stage) {
    return stage < 0 ? Interface{} : validated.stage(stage).interface;
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
            const Pair pair(permutation.vertex, permutation.fragment);
            if (!numbers_.try_emplace(pair, pairs_.size()).second) continue;
            pairs_.push_back(pair);
            for (const int stage : {pair.first, pair.second})
                if (stage >= 0) ++job(stage).pairs_left;
        }
        of_pairs_.resize(pairs_.size());
    }

    /// Works off all pairs by several threads.
    Validated run(const Family& family) {
        if (!pairs_.empty()) {
            validate_pair(0);  // alone: it builds glslang's tables for the version, once
            parallel_for(options_.jobs, pairs_.size() - 1, [&](std::size_t i) { validate_pair(i + 1); });
        }
        parallel_for(options_.jobs, pairs_.size(), [&](std::size_t i) { check_pair(i); });
        DiagnosticGroups groups(family);
        for (const Permutation& permutation : composition_.permutations)
            for (const Diagnostic& diagnostic : diagnostics_of(permutation))
                groups.add(diagnostic, permutation.key);
        validated_.diagnostics = groups.result();
        return std::move(validated_);
    }

  private:
    Job& job(int stage) { return jobs_[static_cast<std::size_t>(stage)]; }

    /// What is wrong with a permutation's stages, or else with the pair.
    [[nodiscard]] Diagnostics diagnostics_of(const Permutation& permutation) {
        const auto [vertex, fragment] = Pair(permutation.vertex, permutation.fragment);
        Diagnostics all;
        if (vertex >= 0) append(all, job(vertex).diagnostics);
        if (fragment >= 0) append(all, job(fragment).diagnostics);
        if (exit_status(all) == 0) append(all, of_pairs_[numbers_.at({vertex, fragment})]);
        return all;
    }

    /// The rules that glslang forgets. Where they find why a pair does not link they say it with both places,
    /// so what glslang said goes.
    void check_pair(std::size_t index) {
        const auto [vertex, fragment] = pairs_[index];
        const auto is_fine = [&](int stage) { return stage < 0 || job(stage).is_fine; };
        if (!is_fine(vertex) || !is_fine(fragment)) return;
        const auto view = [&](int stage) {
            return stage < 0 ? std::nullopt
                             : std::optional(StageView{validated_.stage(stage).interface, pieces_of(stage)});
        };
        const std::optional<StageView> of_vertex = view(vertex);
        const std::optional<StageView> of_fragment = view(fragment);
        Diagnostics& all = of_pairs_[index];
        if (of_vertex && of_fragment) {
            const Diagnostics found = check_link(*of_vertex, *of_fragment);
            if (exit_status(found) != 0) all.clear();
            append(all, found);
        }
        if (exit_status(all) == 0)
            append(all, check_limits(of_vertex ? &*of_vertex : nullptr, of_fragment ? &*of_fragment : nullptr,
                                     composition_.dialect));
    }

    [[nodiscard]] std::vector<const Piece*> pieces_of(int stage) const {
        std::vector<const Piece*> pieces;
        for (const int piece : composition_.stage(stage).pieces) pieces.push_back(&composition_.piece(piece));
        return pieces;
    }
    [[nodiscard]] Place template_of(int stage) const { return {pieces_of(stage).back()->path, 0, 0}; }

    void validate_pair(std::size_t index) {
        const auto [vertex, fragment] = pairs_[index];
        const bool has_vertex = vertex >= 0 && is_parsed(vertex);
        const bool has_fragment = fragment >= 0 && is_parsed(fragment);
        if (has_vertex && has_fragment) {
            const std::scoped_lock lock(job(vertex).mutex, job(fragment).mutex);
            of_pairs_[index] = link(*job(vertex).glslang, *job(fragment).glslang);
            if (exit_status(of_pairs_[index]) != 0) {
                // glslang keeps a failed link's errors in the stages, which other pairs may share.
                job(vertex).glslang->parse();
                job(fragment).glslang->parse();
            }
        }
        for (const int stage : {vertex, fragment})
            if (stage >= 0) release(stage);
    }

    bool is_parsed(int stage) {
        Job& at = job(stage);
        const std::scoped_lock lock(at.mutex);
        if (std::exchange(at.is_parsed, true)) return at.is_fine;
        at.glslang = std::make_unique<GlslangStage>(composition_.stage(stage).kind, pieces_of(stage));
        at.diagnostics = at.glslang->parse();
        return at.is_fine = exit_status(at.diagnostics) == 0;
    }

    /// The last pair of a stage makes its SPIR-V: glslang assigns locations then, which would disturb later
    /// links.
    void release(int stage) {
        Job& at = job(stage);
        if (--at.pairs_left > 0) return;
        const std::scoped_lock lock(at.mutex);
        if (at.is_fine) generate(stage, at);
        at.glslang.reset();
    }

    void generate(int stage, Job& at) {
        Result<ValidatedStage> generated = at.glslang->generate(options_.debug_information);
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
    std::vector<Pair> pairs_;  ///< the distinct ones, in the order in which the permutations first need them
    std::map<Pair, std::size_t> numbers_;
    std::vector<Diagnostics> of_pairs_;
    std::vector<Job> jobs_;
    Validated validated_;
};

}  // namespace

Validated validate(const Family& family, const Composition& composition, const ValidateOptions& options) {
    return Validator(composition, options).run(family);
}

Interface interface_of(const Validated& validated, const Permutation& permutation) {
    if (permutation.vertex < 0) return stage_interface(validated, permutation.fragment);
    if (permutation.fragment < 0) return stage_interface(validated, permutation.vertex);
    return merge(
        {stage_interface(validated, permutation.vertex), stage_interface(validated, permutation.fragment)});
}

}  // namespace gobo
