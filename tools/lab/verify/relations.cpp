#include "lab/verify/relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/parallel.hpp"
#include "family/key.hpp"
#include "lab/oracle/model.hpp"
#include "lab/raster/shade.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"
#include "lab/verify/relation_sides.hpp"
#include "lab/verify/sample.hpp"
#include "lab/verify/stage_check.hpp"

namespace gobo::verify {
namespace {

using raster::Pipeline;

/// What is given to a pipeline: the vertex stage's inputs, both stages' uniforms, gl_FragCoord and the like;
/// each name once, sorted.
std::vector<evaluate::Port> given_ports(const Pipeline& pipeline) {
    std::map<std::string, evaluate::Port> by_name;
    for (const auto* ports :
         {&pipeline.vertex.inputs, &pipeline.vertex.uniforms, &pipeline.fragment.uniforms})
        for (const evaluate::Port& port : *ports) by_name.emplace(port.name, port);
    for (const evaluate::Port& port : pipeline.fragment.inputs)
        if (port.name.starts_with("gl_")) by_name.emplace(port.name, port);
    std::vector<evaluate::Port> ports;
    for (auto& [name, port] : by_name) ports.push_back(std::move(port));
    return ports;
}

/// The part of `points` that a stage reads.
evaluate::Invocations part_of(const evaluate::Program& program, const evaluate::Invocations& points) {
    evaluate::Invocations part;
    part.count = points.count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            if (const auto found = points.values.find(port.name); found != points.values.end())
                part.values.insert(*found);
    for (const evaluate::ImagePort& image : program.images)
        if (const auto found = points.images.find(image.name); found != points.images.end())
            part.images.insert(*found);
    return part;
}

/// What the fragment stage is given at points, and what the vertex stage gave.
struct FragmentsAtPoints {
    evaluate::Invocations invocations;
    evaluate::Outputs vertices;
};

Result<FragmentsAtPoints> fragments_at_points(const Pipeline& pipeline, const evaluate::Invocations& points) {
    FragmentsAtPoints fragments;
    GOBO_TRY(fragments.vertices, evaluate::run<double>(pipeline.vertex, part_of(pipeline.vertex, points)));
    fragments.invocations = part_of(pipeline.fragment, points);
    for (const raster::Varying& varying : pipeline.varyings)
        fragments.invocations.values[varying.input] = fragments.vertices.values.at(varying.output);
    return fragments;
}

/// Runs the vertex stage in fp64, and the fragment stage on what it wrote, as at a vertex. `points` may hold
/// more than the stages read. The fragment stage's outputs, gl_Position, and "discard", 1 where the fragment
/// is discarded and all its outputs 0.
Result<NamedValues> run_at_points(const Pipeline& pipeline, const evaluate::Invocations& points) {
    GOBO_TRY(const FragmentsAtPoints fragments, fragments_at_points(pipeline, points));
    GOBO_TRY(const auto shaded, evaluate::run<double>(pipeline.fragment, fragments.invocations));
    NamedValues outputs = shaded.values;
    for (auto& [name, values] : outputs)
        for (std::size_t k = 0; k < values.size(); ++k)
            if (shaded.discarded[k % points.count]) values[k] = 0;
    outputs["discard"].assign(shaded.discarded.begin(), shaded.discarded.end());
    const auto position = fragments.vertices.values.find("gl_Position");
    if (position != fragments.vertices.values.end()) outputs.insert(*position);
    return outputs;
}

/// A component of an output whose two sides are too far apart.
struct Difference {
    std::string output;
    std::size_t component = 0;
    double one = 0;
    double other = 0;
    double limit = 0;
    double ratio = 0;  ///< of the difference to the limit; infinite for a NaN on one side
};
using Differences = std::map<std::size_t, Difference>;  ///< by point

constexpr double kDoubleRounding = 0x1p-53;

/// The worst component of each point; outputs that only one side has are no concern. `known_to` is the spread
/// of the one side at kRoundingStep.
Differences differences(const NamedValues& here, const NamedValues& there, const NamedValues& known_to,
                        std::size_t count) {
    Differences worst;
    for (const auto& [name, values] : here) {
        const auto others = there.find(name);
        if (others == there.end() || others->second.size() != values.size()) continue;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double one = values[k];
            const double other = others->second[k];
            if (one == other || (std::isnan(one) && std::isnan(other))) continue;
            const std::size_t point = k % count;
            const double known = known_to.at(name)[k] * (kDoubleRounding / kRoundingStep) +
                                 kDoubleRounding * largest_component(values, count, point);
            const double limit = kConditionFactor * known + std::numeric_limits<double>::min();
            const double ratio = ratio_of(std::abs(one - other), limit);
            if (ratio > 1 && ratio > worst[point].ratio)
                worst[point] = {name, k / count, one, other, limit, ratio};
        }
    }
    return worst;
}

/// What the stage that writes `output` is given at a point.
Result<evaluate::EvalPoint> given(const Pipeline& pipeline, const evaluate::Invocations& points,
                                  StageKind stage, std::size_t index) {
    if (stage == StageKind::vertex) return evaluate::point_of(pipeline.vertex, points, index);
    GOBO_TRY(const FragmentsAtPoints fragments, fragments_at_points(pipeline, points));
    return evaluate::point_of(pipeline.fragment, fragments.invocations, index);
}

Result<RelationReport> compare(const Pipeline& one, const Pipeline& other, const Sides& sides,
                               std::uint64_t seed) {
    GOBO_TRY(const NamedValues here, run_at_points(one, sides.one));
    GOBO_TRY(const NamedValues there, run_at_points(other, sides.other));
    const auto spread_by = [&](double step) {
        return spread(given_ports(one), sides.one, here, step, seed,
                      [&](const evaluate::Invocations& moved) { return run_at_points(one, moved); });
    };
    GOBO_TRY(const NamedValues known_to, spread_by(kRoundingStep));
    RelationReport report;
    report.points = sides.one.count;
    Differences broken = differences(here, there, known_to, report.points);
    if (broken.empty()) return report;
    // A step explains a difference where moving the inputs by 1e-5 spreads the output as far.
    GOBO_TRY(const NamedValues far, spread_by(kEdgeStep));
    report.edges = std::erase_if(broken, [&](const auto& point) {
        const auto& [index, difference] = point;
        const double steps = far.at(difference.output)[difference.component * report.points + index];
        return std::abs(difference.one - difference.other) <= 2 * steps;
    });
    report.failed = broken.size();
    if (broken.empty()) return report;
    const auto& [index, worst] = *std::ranges::max_element(
        broken, [](const auto& a, const auto& b) { return a.second.ratio < b.second.ratio; });
    report.found = fmt::format("{}[{}] is {} on one side and {} on the other, which may differ by {:.2g}",
                               worst.output, worst.component, worst.one, worst.other, worst.limit);
    BrokenPoint& point = report.worst.emplace();
    point.stage = worst.output == "gl_Position" ? StageKind::vertex : StageKind::fragment;
    GOBO_TRY(point.one, given(one, sides.one, point.stage, index));
    GOBO_TRY(point.other, given(other, sides.other, point.stage, index));
    return report;
}

// The relation `finer`: on finer meshes a key that computes more per vertex approaches one that does not.

constexpr int kCoarse = 8;  // stacks of a sphere
constexpr int kFine = 32;
/// A mesh four times as fine must at least come this much nearer. What is interpolated linearly is off by the
/// square of an edge's length, a sixteenth; what is flat by its length, a quarter; and where a band's or a
/// cone's rim runs through triangles, by the root of their share, a half, which meshes that do not fall on it
/// alike make a little more.
constexpr double kNearer = 0.7;
/// Of colours this small a difference is rounding, however large the other difference is.
constexpr double kColorRounding = 1e-12;

/// A permutation with what the family's [render] values need to reach it.
struct Drawable {
    const Pipeline& pipeline;
    Interface interface;
};

/// What the fragment stage makes of each triangle's centre, in fp64, lit as `gobo render` shows the family;
/// component by component.
Result<std::vector<double>> colors(const Drawable& drawn, const Mesh& mesh,
                                   const std::vector<RenderValue>& values) {
    const Camera camera = demo_camera();
    ViewedObject view;
    view.view = camera.view();
    view.projection = camera.projection(1);
    view.viewport = {64, 64};
    const Pipeline& pipeline = drawn.pipeline;
    GOBO_TRY(raster::RasterObject object,
             raster::object_inputs(pipeline, drawn.interface, mesh,
                                   raster::with_plain_textures(drawn.interface, values), view));
    raster::Fragment centre;
    centre.is_front_facing = true;
    centre.weights.perspective = centre.weights.linear = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (; centre.triangle < mesh.indices.size() / 3; ++centre.triangle) object.fragments.push_back(centre);
    GOBO_TRY(const auto inputs, raster::exact_fragment_inputs(pipeline, object));
    GOBO_TRY(const auto shaded, evaluate::run<double>(pipeline.fragment, inputs));
    const auto found = shaded.values.find(pipeline.color);
    return found == shaded.values.end() ? std::vector<double>{} : found->second;
}

/// How far two keys are apart, by the root mean square of their colours at the centres of a sphere's
/// triangles.
Result<double> distance(const Drawable& one, const Drawable& other, const std::vector<RenderValue>& values,
                        const Mesh& mesh) {
    GOBO_TRY(const auto here, colors(one, mesh, values));
    GOBO_TRY(const auto there, colors(other, mesh, values));
    double sum = 0;
    for (std::size_t k = 0; k < here.size(); ++k) sum += std::pow(here[k] - there.at(k), 2);
    return here.empty() ? 0 : std::sqrt(sum / static_cast<double>(here.size()));
}

Result<RelationReport> compare_finer(const Drawable& one, const Drawable& other,
                                     const std::vector<RenderValue>& values) {
    const Mesh mesh = make_sphere(2 * kFine, kFine);
    GOBO_TRY(const double coarse, distance(one, other, values, make_sphere(2 * kCoarse, kCoarse)));
    GOBO_TRY(const double fine, distance(one, other, values, mesh));
    RelationReport report;
    report.points = mesh.indices.size() / 3;
    if (fine <= std::max(kNearer * coarse, kColorRounding)) return report;
    report.failed = report.points;
    report.found = fmt::format(
        "a sphere of 8 stacks is {:.3g} away from the other key's (root mean square), and one of 32 "
        "stacks {:.3g}",
        coarse, fine);
    return report;
}

/// Adds what `more` gives, but for what is already there.
void merge(evaluate::Invocations& points, const evaluate::Invocations& more) {
    points.count = more.count;
    points.values.insert(more.values.begin(), more.values.end());
    points.images.insert(more.images.begin(), more.images.end());
}

/// The samples made for the oracle where it knows the key, else points drawn from the family's domains.
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
        GOBO_TRY(const auto bound, bind_inputs(*program, samples));
        merge(points, bound);
    }
    return points;
}

/// The value of the relation's feature where that is a count; else 0.
int count_of(const Family& family, const Relation& relation, const Key& key) {
    if (relation.feature < 0) return 0;
    const auto feature = static_cast<std::size_t>(relation.feature);
    const Feature& counted = family.features[feature];
    return counted.kind == FeatureKind::count ? counted.lowest + key[feature] : 0;
}

/// The permutation of that key; null where the composition has none.
const Permutation* find(const Composition& composition, const std::optional<Key>& key) {
    const auto found = std::ranges::find(composition.permutations, key, &Permutation::key);
    return found == composition.permutations.end() ? nullptr : &*found;
}

/// Whether the relation speaks of the key, so far as its condition and its feature say.
bool speaks_of(const Relation& relation, const Key& key) {
    if (relation.feature >= 0 && key[static_cast<std::size_t>(relation.feature)] == 0) return false;
    return !relation.when || holds(*relation.when, key);
}

}  // namespace

Decoded::Decoded(const Composition& composition, const Validated& validated, int jobs)
    : composition_(composition), validated_(validated), programs_(validated.stages.size()) {
    parallel_for(jobs, programs_.size(),
                 [&](std::size_t i) { programs_[i] = evaluate::decode(validated.stages[i].spirv); });
}

Result<raster::Pipeline> Decoded::pipeline(const Permutation& permutation) const {
    if (!permutation.stages.is_usual_pair())
        return fail(Fault::input, "a permutation of one stage has nothing to join");
    GOBO_TRY(const evaluate::Program& vertex, stage(permutation.stages[StageKind::vertex]));
    GOBO_TRY(const evaluate::Program& fragment, stage(permutation.stages[StageKind::fragment]));
    return raster::join(
        vertex, fragment,
        validated_.stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])].spirv);
}

std::optional<Key> partner_of(const Family& family, const Relation& relation, const Key& key,
                              std::string_view dialect) {
    if (relation.feature < 0 || !speaks_of(relation, key)) return std::nullopt;
    Key other = key;
    int& value = other[static_cast<std::size_t>(relation.feature)];
    const bool is_one_lower = relation.kind == Relation::Kind::off && count_of(family, relation, key) > 0;
    value = is_one_lower ? value - 1 : 0;
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
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<Key> known = keys;
    std::ranges::sort(known);
    std::erase_if(found, [&](const Key& key) { return std::binary_search(known.begin(), known.end(), key); });
    return found;
}

Result<std::vector<RelationReport>> try_relations(const Family& family, const Decoded& decoded,
                                                  const Permutation& permutation, const Pipeline& pipeline,
                                                  std::uint64_t seed) {
    if (family.relations.empty()) return std::vector<RelationReport>{};
    const Composition& composition = decoded.composition();
    GOBO_TRY(const auto points, points_for(family, pipeline, permutation.key, seed));
    std::vector<RelationReport> reports;
    for (std::size_t i = 0; i < family.relations.size(); ++i) {
        const Relation& relation = family.relations[i];
        const Permutation* other =
            find(composition, partner_of(family, relation, permutation.key, name_of(composition.dialect)));
        const bool needs_partner = relation.feature >= 0;
        if (needs_partner ? other == nullptr : !speaks_of(relation, permutation.key)) continue;
        std::optional<Pipeline> partner;
        if (needs_partner) {
            GOBO_TRY(partner, decoded.pipeline(*other));
        }
        RelationReport report;
        if (needs_partner && relation.kind == Relation::Kind::finer) {
            GOBO_TRY(report,
                     compare_finer({pipeline, interface_of(decoded.validated(), permutation)},
                                   {*partner, interface_of(decoded.validated(), *other)}, family.render));
        } else {
            const auto sides = sides_of(relation, given_ports(pipeline),
                                        count_of(family, relation, permutation.key), points, seed);
            if (!sides) continue;
            GOBO_TRY(report, compare(pipeline, partner ? *partner : pipeline, *sides, seed));
        }
        report.relation = i;
        reports.push_back(std::move(report));
    }
    return reports;
}

}  // namespace gobo::verify
