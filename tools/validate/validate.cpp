#include "validate/validate.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "family/diagnostic_groups.hpp"
#include "reflect/interface.hpp"
#include "validate/glslang_stage.hpp"
#include "validate/limits.hpp"
#include "validate/spirv_val.hpp"

namespace gobo {
namespace {

/// A vertex and a fragment stage that some permutation puts together.
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

/// The distinct pairs, in the order in which the permutations first need them.
std::vector<Pair> distinct_pairs(const Composition& composition) {
    std::vector<Pair> pairs;
    std::set<Pair> seen;
    for (const Permutation& permutation : composition.permutations) {
        const Pair pair(permutation.vertex, permutation.fragment);
        if (seen.insert(pair).second) pairs.push_back(pair);
    }
    return pairs;
}

class Validator {
  public:
    Validator(const Composition& composition, const ValidateOptions& options)
        : composition_(composition),
          options_(options),
          pairs_(distinct_pairs(composition)),
          jobs_(composition.stages.size()),
          pair_diagnostics_(pairs_.size()) {
        result_.stages.resize(composition.stages.size());
        for (const auto& [vertex, fragment] : pairs_) {
            if (vertex >= 0) ++job(vertex).pairs_left;
            if (fragment >= 0) ++job(fragment).pairs_left;
        }
    }

    /// Works off all pairs by several threads.
    void run() {
        const GlslangProcess process;
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < pairs_.size(); i = next++) validate_pair(i);
        };
        if (!pairs_.empty())
            validate_pair(next++);  // alone: it builds glslang's tables for the version, once
        std::vector<std::jthread> threads;
        for (int i = 1; i < std::min<int>(options_.jobs, static_cast<int>(pairs_.size())); ++i)
            threads.emplace_back(work);
        work();
    }

    /// The messages with the pair they belong to, or with the stage (a pair of it and -1).
    [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
    [[nodiscard]] const Diagnostics& of_stage(int stage) const {
        return jobs_[static_cast<std::size_t>(stage)].diagnostics;
    }
    [[nodiscard]] const Diagnostics& of_pair(std::size_t pair) const { return pair_diagnostics_[pair]; }
    [[nodiscard]] Validated take_result() { return std::move(result_); }

  private:
    Job& job(int stage) { return jobs_[static_cast<std::size_t>(stage)]; }
    ValidatedStage& output(int stage) { return result_.stages[static_cast<std::size_t>(stage)]; }

    void validate_pair(std::size_t index) {
        const auto [vertex, fragment] = pairs_[index];
        const bool has_vertex = vertex >= 0 && is_parsed(vertex);
        const bool has_fragment = fragment >= 0 && is_parsed(fragment);
        if (has_vertex && has_fragment) {
            const std::scoped_lock lock(job(vertex).mutex, job(fragment).mutex);
            pair_diagnostics_[index] = link(*job(vertex).glslang, *job(fragment).glslang);
            if (exit_status(pair_diagnostics_[index]) != 0) {
                // glslang keeps a failed link's errors in the stages, which other pairs may share.
                job(vertex).glslang->parse();
                job(fragment).glslang->parse();
            }
        }
        if (vertex >= 0) release(vertex);
        if (fragment >= 0) release(fragment);
    }

    bool is_parsed(int stage) {
        Job& at = job(stage);
        const std::scoped_lock lock(at.mutex);
        if (at.is_parsed) return at.is_fine;
        const Stage& source = composition_.stages[static_cast<std::size_t>(stage)];
        std::vector<const Piece*> pieces;
        for (const int piece : source.pieces)
            pieces.push_back(&composition_.pieces[static_cast<std::size_t>(piece)]);
        at.glslang = std::make_unique<GlslangStage>(source.kind, std::move(pieces));
        at.is_fine = at.glslang->parse();
        at.diagnostics = at.glslang->diagnostics();
        at.is_parsed = true;
        return at.is_fine;
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
            at.diagnostics.insert(at.diagnostics.end(), generated.error().begin(), generated.error().end());
            at.is_fine = false;
            return;
        }
        if (options_.spirv_val) {
            const std::string& template_path =
                composition_
                    .pieces[static_cast<std::size_t>(
                        composition_.stages[static_cast<std::size_t>(stage)].pieces.back())]
                    .path;
            Diagnostics found = spirv_val(generated->spirv, {template_path, 0, 0});
            at.diagnostics.insert(at.diagnostics.end(), found.begin(), found.end());
        }
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
        output(stage) = std::move(*generated);
    }

    const Composition& composition_;
    const ValidateOptions& options_;
    std::vector<Pair> pairs_;
    std::vector<Job> jobs_;
    std::vector<Diagnostics> pair_diagnostics_;
    Validated result_;
};

Interface stage_interface(const Validated& validated, int stage) {
    return stage < 0 ? Interface{} : validated.stages[static_cast<std::size_t>(stage)].interface;
}

/// What glslang said of a permutation's stages and of the pair, and what lies beyond the dialect's limits.
Diagnostics diagnostics_of(const Validator& validator, const Composition& composition,
                           const Validated& result, const Permutation& permutation, std::size_t pair) {
    Diagnostics all;
    const auto append = [&](const Diagnostics& found) { all.insert(all.end(), found.begin(), found.end()); };
    if (permutation.vertex >= 0) append(validator.of_stage(permutation.vertex));
    if (permutation.fragment >= 0) append(validator.of_stage(permutation.fragment));
    append(validator.of_pair(pair));
    if (exit_status(all) != 0) return all;

    const int last = permutation.fragment >= 0 ? permutation.fragment : permutation.vertex;
    const int last_piece = composition.stages[static_cast<std::size_t>(last)].pieces.back();
    const Place place{composition.pieces[static_cast<std::size_t>(last_piece)].path, 0, 0};
    const Interface vertex = stage_interface(result, permutation.vertex);
    const Interface fragment = stage_interface(result, permutation.fragment);
    append(beyond_limits(vertex, fragment, limits_of(composition.dialect), place));
    if (permutation.vertex >= 0 && permutation.fragment >= 0)
        append(unwritten_inputs(vertex, fragment, place));
    return all;
}

}  // namespace

Validated validate(const Family& family, const Composition& composition, const ValidateOptions& options) {
    Validator validator(composition, options);
    validator.run();
    std::map<Pair, std::size_t> pair_numbers;
    for (std::size_t i = 0; i < validator.pairs().size(); ++i) pair_numbers[validator.pairs()[i]] = i;
    Validated result = validator.take_result();

    DiagnosticGroups groups(family);
    for (const Permutation& permutation : composition.permutations) {
        const std::size_t pair = pair_numbers[{permutation.vertex, permutation.fragment}];
        for (const Diagnostic& diagnostic :
             diagnostics_of(validator, composition, result, permutation, pair)) {
            groups.add(diagnostic, permutation.key);
        }
    }
    result.diagnostics = groups.result();
    return result;
}

Interface interface_of(const Validated& validated, const Permutation& permutation) {
    if (permutation.vertex < 0) return stage_interface(validated, permutation.fragment);
    if (permutation.fragment < 0) return stage_interface(validated, permutation.vertex);
    return merge({stage_interface(validated, permutation.vertex),
                  stage_interface(validated, permutation.fragment)});
}

}  // namespace gobo
