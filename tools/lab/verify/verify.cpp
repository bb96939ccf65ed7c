#include "lab/verify/verify.hpp"

#define XXH_INLINE_ALL
#include <nlohmann/json.hpp>
#include <xxhash.h>

#include "core/parallel.hpp"
#include "family/key.hpp"
#include "lab/verify/on_mesh.hpp"
#include "lab/verify/reflection_laws.hpp"
#include "lab/verify/stage_check.hpp"

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
        for (const int stage : permutation.stages.values) {
            if (stage < 0) continue;  // loose files may leave one out
            if (Result<StageReport> found = check(stage, permutation.key, models))
                report.add(*std::move(found), 2 * kWorstPoints);
            else
                add(report, std::move(found).error());
        }
        if (!permutation.stages.is_usual_pair() || !report.diagnostics.empty()) return report;
        if (const Result<void> done = check_together(report, permutation, models); !done)
            add(report, done.error());
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
        GOBO_TRY(const evaluate::Program& program, decoded_.stage(stage));
        const StageKind kind = decoded_.kind_of(stage);
        const std::uint64_t seed = seed_of(key);
        const int count = kind == StageKind::vertex ? options_.vertices : options_.fragments;
        if (models.empty()) return check_alone(program, kind, family_.domains, count, seed);
        const bool is_one = models.size() == 1;
        StageReport all;
        for (std::size_t i = 0; i < models.size(); ++i) {
            GOBO_TRY(auto one, check_against_oracle(program, kind, models[i], is_one ? count : kPointsOfModel,
                                                    seed + i));
            all.add(std::move(one));
        }
        return all;
    }

    /// Both stages: on meshes where there is an oracle, and by the family's relations.
    Result<void> check_together(PermutationReport& report, const Permutation& permutation,
                                const std::vector<oracle::Model>& models) const {
        if (models.empty() && family_.relations.empty()) return {};
        GOBO_TRY(const raster::Pipeline pipeline, decoded_.pipeline(permutation));
        const std::uint64_t seed = seed_of(permutation.key);
        for (std::size_t i = 0; i < options_.meshes.size() && !models.empty(); ++i) {
            const oracle::Model& model = models[i * models.size() / options_.meshes.size()];
            GOBO_TRY(auto found, check_on_mesh(pipeline, model, options_.meshes[i], seed + i + 1));
            for (StageReport& stage : found) {
                report.points_on_meshes += stage.figures.points;
                report.add(std::move(stage), 2 * kWorstPoints);
            }
        }
        if (models.size() == 1 && models.front().is_physical()) {
            GOBO_TRY(auto laws, check_laws(pipeline.fragment, models.front(), seed));
            report.points_of_laws = laws.figures.points;
            report.add(std::move(laws), 2 * kWorstPoints);
        }
        GOBO_TRY(report.relations, try_relations(family_, decoded_, permutation, pipeline, seed));
        return {};
    }

    /// Of the key's text alone.
    [[nodiscard]] std::uint64_t seed_of(const Key& key) const {
        const std::string text = key_text(family_, key);
        return XXH3_64bits(text.data(), text.size());
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
    parallel_for(options.jobs, report.permutations.size(), [&](std::size_t i) {
        report.permutations[i] = verifier.verify(composition.permutations[i]);
    });
    for (const PermutationReport& permutation : report.permutations) {
        report.figures += permutation.figures;
        report.points_on_meshes += permutation.points_on_meshes;
        report.points_of_laws += permutation.points_of_laws;
        if (!permutation.has_oracle) ++report.without_oracle;
    }
    return report;
}

std::string figures_json(const Family& family, const VerifyReport& report) {
    using Json = nlohmann::ordered_json;
    Json permutations = Json::array();
    for (const PermutationReport& permutation : report.permutations)
        permutations.push_back({{"key", key_text(family, permutation.key)},
                                {"points", permutation.figures.points},
                                {"largest_fp32_error", permutation.figures.largest_fp32_error},
                                {"largest_fp64_error", permutation.figures.largest_fp64_error}});
    const Json figures = {{"family", family.name}, {"permutations", std::move(permutations)}};
    return figures.dump(1) + "\n";
}

}  // namespace gobo::verify
