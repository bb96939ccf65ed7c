#include "lab/study/candidates.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "lab/study/front.hpp"
#include "budget/qualities.hpp"
#include "lab/verify/parallel.hpp"

namespace gobo::study {
namespace {

/// Points of each scene that a quality is screened on.
constexpr std::size_t kScreenPoints = 96;
/// More than these are a crowd: the screening gets stricter until they are fewer.
constexpr std::size_t kMostMeasured = 192;

/// What a screening forgives: costs and errors of so few points are rough.
struct Slack {
    double cost;
    double error;
};
constexpr std::array<Slack, 4> kSlacks = {{{1.1, 1.5}, {1.05, 1.25}, {1.02, 1.1}, {1, 1}}};

Result<std::vector<ScenePoints>> points_of(const Family& family, const Variant& accurate,
                                           const std::vector<DrawnScene>& scenes, int jobs) {
    std::vector<Result<ScenePoints>> found(scenes.size());
    verify::for_each_index(scenes.size(), jobs,
                           [&](std::size_t i) { found[i] = find_points(family, accurate, scenes[i]); });
    std::vector<ScenePoints> points;
    for (const Result<ScenePoints>& one : found) {
        if (!one) return tl::unexpected(one.error());
        points.push_back(thinned(*one, kScreenPoints));
    }
    return points;
}

/// The worst error over the scenes, and the mean cost.
Result<Priced> price(const std::vector<ScenePoints>& scenes, const Variant& variant, const Weights& weights) {
    Priced priced;
    for (const ScenePoints& points : scenes) {
        Measurement rough;
        const auto colors = shade_points<float>(points, variant, &rough.work);
        if (!colors) return tl::unexpected(colors.error());
        rough.pixels = points.pixels;
        rough.shown_vertices = points.shown_vertices;
        rough.mesh_vertices = points.mesh_vertices;
        priced.error = std::max(priced.error, error_between(points, *colors, reference_colors(points)).max);
        priced.cost += costs_of(rough, weights).fragment;
        priced.cost += costs_of(rough, weights).vertex * 0.05;  // a mesh has a vertex for some twenty pixels
    }
    return priced;
}

Result<std::vector<Key>> screen(const Family& family, const SearchPath& search, const Key& accurate,
                                const std::vector<Key>& keys, const std::vector<DrawnScene>& scenes,
                                const Weights& weights, int jobs) {
    const Result<Variants> variants = load_variants(family, search, keys, jobs);
    if (!variants) return tl::unexpected(variants.error());
    const auto points = points_of(family, variants->at(accurate), scenes, jobs);
    if (!points) return tl::unexpected(points.error());
    std::vector<Result<Priced>> results(keys.size());
    verify::for_each_index(keys.size(), jobs, [&](std::size_t i) {
        results[i] = price(*points, variants->at(keys[i]), weights);
    });
    std::vector<Priced> priced;
    for (const Result<Priced>& one : results) {
        if (!one) return tl::unexpected(one.error());
        priced.push_back(*one);
    }
    std::vector<Key> kept;
    for (const Slack& slack : kSlacks) {
        kept.clear();
        const std::vector<bool> near = near_front(priced, slack.cost, slack.error);
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (near[i]) kept.push_back(keys[i]);
        if (kept.size() <= kMostMeasured) break;
    }
    return kept;
}

}  // namespace

Result<Candidates> find_candidates(const Family& family, const SearchPath& search, const Key& effects,
                                   const std::vector<DrawnScene>& scenes, const Weights& weights, int jobs) {
    const Key accurate = most_accurate(family, effects);
    Candidates candidates;
    candidates.keys = {accurate};
    for (const Choice& choice : single_choices(family, effects)) candidates.keys.push_back(choice.key);
    std::vector<Key> all = all_qualities(family, effects, kMostScreened);
    std::set<Key> considered(all.begin(), all.end());
    considered.insert(candidates.keys.begin(), candidates.keys.end());  // retired values are single choices only
    candidates.considered = considered.size();
    if (all.size() > kMeasuredWithoutScreening) {
        Result<std::vector<Key>> kept = screen(family, search, accurate, all, scenes, weights, jobs);
        if (!kept) return tl::unexpected(kept.error());
        all = std::move(*kept);
    }
    std::set<Key> seen(candidates.keys.begin(), candidates.keys.end());
    for (Key& key : all)
        if (seen.insert(key).second) candidates.keys.push_back(std::move(key));
    return candidates;
}

}  // namespace gobo::study
