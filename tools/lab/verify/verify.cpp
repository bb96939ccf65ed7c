#include "lab/verify/verify.hpp"

#include <algorithm>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "family/key.hpp"
#include "lab/verify/against_oracle.hpp"
#include "lab/verify/alone.hpp"
#include "lab/verify/on_mesh.hpp"
#include "lab/verify/parallel.hpp"
#include "lab/verify/try_relations.hpp"

namespace gobo::verify {
namespace {

/// Samples of each stage for each model, where a key stands for several.
constexpr int kPointsOfModel = 16;

/// Verifies one permutation after the other, keeping what all share.
class Verifier {
  public:
    Verifier(const Family& family, const Decoded& decoded, const VerifyOptions& options)
        : family_(family), decoded_(decoded), options_(options) {}

    [[nodiscard]] PermutationReport verify(const Permutation& permutation) const {
        PermutationReport report;
        report.key = permutation.key;
        const std::vector<oracle::Model> models = models_of(permutation.key);
        report.has_oracle = !models.empty();
        for (const int stage : {permutation.vertex, permutation.fragment}) {
            if (stage < 0) continue;  // loose files may leave one out
            Result<StageReport> found = check(stage, permutation.key, models);
            if (found)
                add(report, std::move(*found));
            else
                add(report, std::move(found.error()));
        }
        const bool is_whole = permutation.vertex >= 0 && permutation.fragment >= 0;
        if (!is_whole || !report.diagnostics.empty()) return report;
        if (!models.empty()) check_on_meshes(report, permutation, models);
        if (!family_.relations.empty()) check_relations(report, permutation);
        return report;
    }

  private:
    [[nodiscard]] std::vector<oracle::Model> models_of(const Key& key) const {
        if (options_.models) return options_.models(key);
        const auto model = oracle::model_of(family_, key);
        return model ? std::vector{*model} : std::vector<oracle::Model>{};
    }

    [[nodiscard]] Result<StageReport> check(int stage, const Key& key,
                                            const std::vector<oracle::Model>& models) const {
        const Result<evaluate::Program>& program = decoded_.stage(stage);
        if (!program) return tl::unexpected(program.error());
        const StageKind kind = decoded_.kind_of(stage);
        const std::uint64_t seed = seed_of(key);
        const int count = kind == StageKind::vertex ? options_.vertices : options_.fragments;
        if (models.empty()) return check_alone(*program, kind, family_.domains, count, seed);
        const bool is_one = models.size() == 1;
        StageReport all;
        for (std::size_t i = 0; i < models.size(); ++i) {
            Result<StageReport> one =
                check_against_oracle(*program, kind, models[i], is_one ? count : kPointsOfModel, seed + i);
            if (!one) return one;
            all.figures += one->figures;
            all.failed_points += one->failed_points;
            for (Failure& failure : one->worst) add_failure(all, std::move(failure));
        }
        return all;
    }

    void check_on_meshes(PermutationReport& report, const Permutation& permutation,
                         const std::vector<oracle::Model>& models) const {
        const Result<Pipeline> pipeline = decoded_.pipeline(permutation);
        if (!pipeline) return add(report, pipeline.error());
        for (std::size_t i = 0; i < options_.meshes.size(); ++i) {
            const oracle::Model& model = models[i * models.size() / options_.meshes.size()];
            auto found =
                check_on_mesh(*pipeline, model, options_.meshes[i], seed_of(permutation.key) + i + 1);
            if (!found) return add(report, std::move(found.error()));
            for (StageReport& stage : *found) {
                report.points_on_meshes += stage.figures.points;
                add(report, std::move(stage));
            }
        }
    }

    void check_relations(PermutationReport& report, const Permutation& permutation) const {
        auto found = try_relations(family_, decoded_, permutation, seed_of(permutation.key));
        if (!found) return add(report, std::move(found.error()));
        report.relations = std::move(*found);
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
    const Decoded& decoded_;
    const VerifyOptions& options_;
};

}  // namespace

VerifyReport verify(const Family& family, const Composition& composition, const Validated& validated,
                    const VerifyOptions& options) {
    const Decoded decoded(composition, validated, options.jobs);
    const Verifier verifier(family, decoded, options);
    VerifyReport report;
    report.permutations.resize(composition.permutations.size() - options.partners);
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
