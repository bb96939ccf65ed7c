#include "lab/verify/relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/oracle/model.hpp"
#include "lab/verify/alone.hpp"
#include "lab/verify/random_points.hpp"
#include "lab/verify/relation_sides.hpp"

namespace gobo::verify {
namespace {

/// A component of an output whose two sides are too far apart.
struct Difference {
    std::string output;
    std::uint32_t component = 0;
    double one = 0;
    double other = 0;
    double limit = 0;
    double ratio = 0;  ///< of the difference to the limit; infinite for a NaN on one side
};
using Differences = std::vector<std::optional<Difference>>;  ///< of each point

constexpr int kMoves = 6;  // each input goes either way in some of them
/// The outputs' spread is measured by moving the inputs by this much, and taken to be proportional to it.
constexpr double kProbe = 0x1p-24;
constexpr double kDoubleRounding = 0x1p-53;
constexpr double kEdge = 1e-5;

/// How far the outputs move with the inputs.
Result<PointOutputs> spread(const Pipeline& pipeline, const evaluate::Invocations& points,
                            const PointOutputs& outputs, double step, std::uint64_t seed) {
    PointOutputs widest;
    for (int i = 0; i < kMoves; ++i) {
        const Result<PointOutputs> there = run_at_points(
            pipeline, moved(pipeline.given(), points, step, seed + static_cast<std::uint64_t>(i)));
        if (!there) return tl::unexpected(there.error());
        for (const auto& [name, values] : outputs) {
            std::vector<double>& most = widest[name];
            most.resize(values.size());
            for (std::size_t k = 0; k < values.size(); ++k)
                most[k] = std::max(most[k], std::abs(there->at(name)[k] - values[k]));
        }
    }
    return widest;
}

/// The largest component of an output at a point.
double size_at(const std::vector<double>& values, std::size_t count, std::size_t index) {
    double size = 0;
    for (std::size_t k = index; k < values.size(); k += count) size = std::max(size, std::abs(values[k]));
    return size;
}

double ratio_of(double difference, double limit) {
    if (difference <= limit) return limit > 0 ? difference / limit : 0;
    return std::isnan(difference) || limit == 0 ? std::numeric_limits<double>::infinity()
                                                : difference / limit;
}

/// Both sides evaluated.
struct Evaluated {
    const Sides& sides;
    PointOutputs one;
    PointOutputs other;
    PointOutputs known_to;  ///< spread of `one` at kProbe
};

/// The worst component of each point; outputs that only one side has are no concern.
Differences differences(const Evaluated& both) {
    const std::size_t count = both.sides.one.count;
    Differences worst(count);
    for (const auto& [name, values] : both.one) {
        const auto there = both.other.find(name);
        if (there == both.other.end() || there->second.size() != values.size()) continue;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double one = values[k];
            const double other = there->second[k];
            if (one == other || (std::isnan(one) && std::isnan(other))) continue;
            const double known_to = both.known_to.at(name)[k] * (kDoubleRounding / kProbe) +
                                    kDoubleRounding * size_at(values, count, k % count);
            const double limit = kConditionFactor * known_to + std::numeric_limits<double>::min();
            const double ratio = ratio_of(std::abs(one - other), limit);
            std::optional<Difference>& broken = worst[k % count];
            if (ratio <= 1 || (broken && broken->ratio >= ratio)) continue;
            broken = Difference{name, static_cast<std::uint32_t>(k / count), one, other, limit, ratio};
        }
    }
    return worst;
}

/// Points whose difference a step explains: moving the inputs by 1e-5 spreads the output as far.
Result<bool> leave_out_edges(const Pipeline& pipeline, const Evaluated& both, std::uint64_t seed,
                             Differences& broken, RelationReport& report) {
    if (std::none_of(broken.begin(), broken.end(), [](const auto& one) { return one.has_value(); }))
        return true;
    const Result<PointOutputs> far = spread(pipeline, both.sides.one, both.one, kEdge, seed);
    if (!far) return tl::unexpected(far.error());
    for (std::size_t i = 0; i < broken.size(); ++i) {
        if (!broken[i]) continue;
        const double steps = far->at(broken[i]->output)[broken[i]->component * broken.size() + i];
        if (!(std::abs(broken[i]->one - broken[i]->other) <= 2 * steps)) continue;
        ++report.edges;
        broken[i].reset();
    }
    return true;
}

/// What the stage that writes `output` is given at a point.
Result<evaluate::EvalPoint> given(const Pipeline& pipeline, const evaluate::Invocations& points,
                                  StageKind stage, std::size_t index) {
    if (stage == StageKind::vertex) return evaluate::point_of(pipeline.vertex, points, index);
    const auto fragments = fragments_at_points(pipeline, points);
    if (!fragments) return tl::unexpected(fragments.error());
    return evaluate::point_of(pipeline.fragment, fragments->invocations, index);
}

Result<bool> describe(const Pipeline& one, const Pipeline& other, const Sides& sides,
                      const Differences& broken, RelationReport& report) {
    std::size_t worst = broken.size();
    for (std::size_t i = 0; i < broken.size(); ++i) {
        if (!broken[i]) continue;
        ++report.failed;
        if (worst == broken.size() || broken[i]->ratio > broken[worst]->ratio) worst = i;
    }
    if (report.failed == 0) return true;
    const Difference& difference = *broken[worst];
    report.found = fmt::format("{}[{}] is {} on one side and {} on the other, which may differ by {:.2g}",
                               difference.output, difference.component, difference.one, difference.other,
                               difference.limit);
    const StageKind stage = difference.output == "gl_Position" ? StageKind::vertex : StageKind::fragment;
    Result<evaluate::EvalPoint> here = given(one, sides.one, stage, worst);
    if (!here) return tl::unexpected(here.error());
    Result<evaluate::EvalPoint> there = given(other, sides.other, stage, worst);
    if (!there) return tl::unexpected(there.error());
    report.worst = BrokenPoint{stage, std::move(*here), std::move(*there)};
    return true;
}

Result<RelationReport> compare(const Pipeline& one, const Pipeline& other, const Sides& sides,
                               std::uint64_t seed) {
    Result<PointOutputs> here = run_at_points(one, sides.one);
    if (!here) return tl::unexpected(here.error());
    Result<PointOutputs> there = run_at_points(other, sides.other);
    if (!there) return tl::unexpected(there.error());
    Result<PointOutputs> known_to = spread(one, sides.one, *here, kProbe, seed);
    if (!known_to) return tl::unexpected(known_to.error());
    const Evaluated both{sides, std::move(*here), std::move(*there), std::move(*known_to)};
    Differences broken = differences(both);
    RelationReport report;
    report.points = sides.one.count;
    if (const auto left = leave_out_edges(one, both, seed, broken, report); !left)
        return tl::unexpected(left.error());
    if (const auto told = describe(one, other, sides, broken, report); !told)
        return tl::unexpected(told.error());
    return report;
}

/// The value of the relation's feature where that is a count; else 0.
int count_of(const Family& family, const Relation& relation, const Key& key) {
    if (relation.feature < 0) return 0;
    const auto feature = static_cast<std::size_t>(relation.feature);
    return family.features[feature].kind == FeatureKind::count ? key[feature] : 0;
}

}  // namespace

bool speaks_of(const Relation& relation, const Key& key) {
    if (relation.feature >= 0 && key[static_cast<std::size_t>(relation.feature)] == 0) return false;
    return !relation.when || holds(*relation.when, key);
}

std::optional<Key> partner_of(const Family& family, const Relation& relation, const Key& key,
                              std::string_view dialect) {
    if (relation.feature < 0 || !speaks_of(relation, key)) return std::nullopt;
    Key other = key;
    int& value = other[static_cast<std::size_t>(relation.feature)];
    value = relation.kind == Relation::Kind::off ? std::max(count_of(family, relation, key) - 1, 0) : 0;
    other = canonical(family, std::move(other), dialect);
    if (other == key || forbidding_rule(family, other, dialect) != nullptr) return std::nullopt;
    return other;
}

std::vector<Key> partners(const Family& family, const std::vector<Key>& keys, std::string_view dialect) {
    std::vector<Key> found;
    for (const Relation& relation : family.relations)
        for (const Key& key : keys)
            if (!oracle::model_of(family, key))
                if (auto partner = partner_of(family, relation, key, dialect))
                    found.push_back(std::move(*partner));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<Key> known = keys;
    std::sort(known.begin(), known.end());
    std::erase_if(found, [&](const Key& key) { return std::binary_search(known.begin(), known.end(), key); });
    return found;
}

Result<std::optional<RelationReport>> try_relation(const Family& family, std::size_t relation, const Key& key,
                                                   const Pipeline& pipeline, const Pipeline* partner,
                                                   const evaluate::Invocations& points, std::uint64_t seed) {
    const Relation& stated = family.relations[relation];
    const bool needs_partner = stated.feature >= 0;
    if (!speaks_of(stated, key) || (needs_partner && partner == nullptr)) return std::nullopt;
    const auto sides = sides_of(stated, pipeline.given(), count_of(family, stated, key), points, seed);
    if (!sides) return std::nullopt;
    Result<RelationReport> report = compare(pipeline, needs_partner ? *partner : pipeline, *sides, seed);
    if (!report) return tl::unexpected(report.error());
    report->relation = relation;
    return std::optional(std::move(*report));
}

}  // namespace gobo::verify
