#include "lab/verify/try_relations.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "lab/oracle/model.hpp"
#include "validate/validate.hpp"
#include "lab/verify/feed.hpp"
#include "lab/verify/finer.hpp"
#include "lab/verify/random_points.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {
namespace {

/// Adds what `more` gives, but for what is already there.
void merge(evaluate::Invocations& points, const evaluate::Invocations& more) {
    points.count = more.count;
    points.values.insert(more.values.begin(), more.values.end());
    points.images.insert(more.images.begin(), more.images.end());
}

Result<evaluate::Invocations> points_for(const Family& family, const Pipeline& pipeline, const Key& key,
                                         std::uint64_t seed) {
    evaluate::Invocations points;
    const auto model = oracle::model_of(family, key);
    if (!model) {
        merge(points, draw_points(pipeline.vertex, family.domains, kRelationPoints, seed));
        merge(points, draw_points(pipeline.fragment, family.domains, kRelationPoints, seed + 1));
        return points;
    }
    const std::vector<Sample> samples =
        make_samples(*model, StageKind::vertex, static_cast<int>(kRelationPoints), seed);
    for (const evaluate::Program* program : {&pipeline.vertex, &pipeline.fragment}) {
        const auto fed = feed(*program, samples);
        if (!fed) return tl::unexpected(fed.error());
        merge(points, *fed);
    }
    return points;
}

/// Tries them on one permutation.
class Trial {
  public:
    Trial(const Family& family, const Decoded& decoded, const Permutation& permutation, std::uint64_t seed)
        : family_(family), decoded_(decoded), permutation_(permutation), seed_(seed) {}

    Result<std::vector<RelationReport>> run() const {
        const Result<Pipeline> pipeline = decoded_.pipeline(permutation_);
        if (!pipeline) return tl::unexpected(pipeline.error());
        const auto points = points_for(family_, *pipeline, permutation_.key, seed_);
        if (!points) return tl::unexpected(points.error());
        std::vector<RelationReport> reports;
        for (std::size_t i = 0; i < family_.relations.size(); ++i) {
            auto report = run(i, *pipeline, *points);
            if (!report) return tl::unexpected(report.error());
            if (*report) reports.push_back(std::move(**report));
        }
        return reports;
    }

  private:
    [[nodiscard]] Result<std::optional<RelationReport>> run(std::size_t index, const Pipeline& pipeline,
                                                            const evaluate::Invocations& points) const {
        const Relation& relation = family_.relations[index];
        const Permutation* other = partner(relation);
        if (relation.feature >= 0 && other == nullptr) return std::nullopt;
        if (other == nullptr)
            return try_relation(family_, index, permutation_.key, pipeline, nullptr, points, seed_);
        const Result<Pipeline> there = decoded_.pipeline(*other);
        if (!there) return tl::unexpected(there.error());
        if (relation.kind == Relation::Kind::finer) return run_finer(index, pipeline, *other, *there);
        return try_relation(family_, index, permutation_.key, pipeline, &*there, points, seed_);
    }

    [[nodiscard]] const Permutation* partner(const Relation& relation) const {
        const Composition& composition = decoded_.composition();
        const auto key = partner_of(family_, relation, permutation_.key, name_of(composition.dialect));
        if (!key) return nullptr;
        const auto found =
            std::find_if(composition.permutations.begin(), composition.permutations.end(),
                         [&](const Permutation& permutation) { return permutation.key == *key; });
        return found == composition.permutations.end() ? nullptr : &*found;
    }

    [[nodiscard]] Result<std::optional<RelationReport>> run_finer(std::size_t index, const Pipeline& pipeline,
                                                                  const Permutation& other,
                                                                  const Pipeline& there) const {
        const Interface here = interface_of(decoded_.validated(), permutation_);
        const Interface other_interface = interface_of(decoded_.validated(), other);
        const auto found = approach({pipeline, here}, {there, other_interface}, family_.render);
        if (!found) return tl::unexpected(found.error());
        RelationReport report;
        report.relation = index;
        report.points = found->triangles;
        if (found->holds()) return report;
        report.failed = report.points;
        report.found = fmt::format(
            "a sphere of 8 stacks is {:.3g} away from the other key's (root mean square), and one of 32 "
            "stacks {:.3g}",
            found->coarse, found->fine);
        return report;
    }

    const Family& family_;
    const Decoded& decoded_;
    const Permutation& permutation_;
    std::uint64_t seed_;
};

}  // namespace

Result<std::vector<RelationReport>> try_relations(const Family& family, const Decoded& decoded,
                                                  const Permutation& permutation, std::uint64_t seed) {
    return Trial(family, decoded, permutation, seed).run();
}

}  // namespace gobo::verify
