#include "verify/verify.hpp"

#include <algorithm>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "family/key.hpp"
#include "oracle/model.hpp"
#include "verify/against_oracle.hpp"
#include "verify/alone.hpp"
#include "verify/on_mesh.hpp"
#include "verify/parallel.hpp"

namespace gobo::verify {
namespace {

using Programs = std::vector<Result<evaluate::Program>>;

Programs decode_all(const Validated& validated, int jobs) {
    Programs programs(validated.stages.size());
    for_each_index(programs.size(), jobs,
                   [&](std::size_t i) { programs[i] = evaluate::decode(validated.stages[i].spirv); });
    return programs;
}

/// Verifies one permutation after the other, keeping what all share.
class Verifier {
  public:
    Verifier(const Family& family, const Composition& composition, const Validated& validated,
             const Programs& programs, const VerifyOptions& options)
        : family_(family),
          composition_(composition),
          validated_(validated),
          programs_(programs),
          options_(options) {}

    [[nodiscard]] PermutationReport verify(const Permutation& permutation) const {
        PermutationReport report;
        report.key = permutation.key;
        const auto model = oracle::model_of(family_, permutation.key);
        report.has_oracle = model.has_value();
        for (const int stage : {permutation.vertex, permutation.fragment}) {
            if (stage < 0) continue;  // loose files may leave one out
            Result<StageReport> found = check(static_cast<std::size_t>(stage), permutation.key, model);
            if (found)
                add(report, std::move(*found));
            else
                add(report, std::move(found.error()));
        }
        if (model && report.diagnostics.empty()) check_on_meshes(report, permutation, *model);
        return report;
    }

  private:
    [[nodiscard]] Result<StageReport> check(std::size_t stage, const Key& key,
                                            const tl::expected<oracle::Model, std::string>& model) const {
        const Result<evaluate::Program>& program = programs_[stage];
        if (!program) return tl::unexpected(program.error());
        const StageKind kind = composition_.stages[stage].kind;
        const std::uint64_t seed = seed_of(key);
        const int count = kind == StageKind::vertex ? options_.vertices : options_.fragments;
        return model ? check_against_oracle(*program, kind, *model, count, seed)
                     : check_alone(*program, kind, family_.domains, count, seed);
    }

    void check_on_meshes(PermutationReport& report, const Permutation& permutation,
                         const oracle::Model& model) const {
        if (permutation.vertex < 0 || permutation.fragment < 0) return;
        const auto fragment = static_cast<std::size_t>(permutation.fragment);
        const evaluate::Program& first = *programs_[static_cast<std::size_t>(permutation.vertex)];
        const evaluate::Program& second = *programs_[fragment];
        Result<Link> joined = link(first, second, validated_.stages[fragment].spirv);
        if (!joined) return add(report, std::move(joined.error()));
        const Pipeline pipeline{first, second, std::move(*joined)};
        for (std::size_t i = 0; i < options_.meshes.size(); ++i) {
            auto found = check_on_mesh(pipeline, model, options_.meshes[i], seed_of(permutation.key) + i + 1);
            if (!found) return add(report, std::move(found.error()));
            for (StageReport& stage : *found) {
                report.points_on_meshes += stage.figures.points;
                add(report, std::move(stage));
            }
        }
    }

    /// Of the key's text alone.
    [[nodiscard]] std::uint64_t seed_of(const Key& key) const {
        const std::string text = key_text(family_, key);
        return XXH3_64bits(text.data(), text.size());
    }

    void add(PermutationReport& report, StageReport found) const {
        report.figures += found.figures;
        report.failed_points += found.failed_points;
        for (Failure& failure : found.worst) report.worst.push_back(std::move(failure));
        std::stable_sort(report.worst.begin(), report.worst.end(),
                         [](const Failure& left, const Failure& right) { return left.ratio > right.ratio; });
        if (report.worst.size() > 2 * kWorstPoints) report.worst.resize(2 * kWorstPoints);
    }

    void add(PermutationReport& report, Diagnostics errors) const {
        for (Diagnostic& error : errors) {
            error.subject = key_text(family_, report.key);
            report.diagnostics.push_back(std::move(error));
        }
    }

    const Family& family_;
    const Composition& composition_;
    const Validated& validated_;
    const Programs& programs_;
    const VerifyOptions& options_;
};

}  // namespace

VerifyReport verify(const Family& family, const Composition& composition, const Validated& validated,
                    const VerifyOptions& options) {
    const Programs programs = decode_all(validated, options.jobs);
    const Verifier verifier(family, composition, validated, programs, options);
    VerifyReport report;
    report.permutations.resize(composition.permutations.size());
    for_each_index(report.permutations.size(), options.jobs, [&](std::size_t i) {
        report.permutations[i] = verifier.verify(composition.permutations[i]);
    });
    for (const PermutationReport& permutation : report.permutations) {
        report.figures += permutation.figures;
        report.points_on_meshes += permutation.points_on_meshes;
        if (!permutation.has_oracle) ++report.without_oracle;
    }
    return report;
}

}  // namespace gobo::verify
