#include "lab/study/curves.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "lab/study/measure.hpp"
#include "lab/study/measurement_json.hpp"
#include "budget/qualities.hpp"
#include "lab/verify/parallel.hpp"

namespace gobo::study {
namespace {

constexpr std::array<int, 6> kSlices = {8, 16, 32, 64, 128, 256};

/// One scene along a curve.
struct Stop {
    double number = 0;
    DrawnScene scene;
};

/// A feature's values along the stops.
struct Line {
    std::string feature;
    std::string over;
    std::string effects;
    std::vector<Stop> stops;
};

Line tessellation_line(const Family& family, const StudyPlan& plan, const std::string& feature) {
    // The plan's last quick effects show most.
    Line line{feature, "slices", plan.quick.back(), {}};
    for (const int slices : kSlices)
        line.stops.push_back(
            {static_cast<double>(slices), sphere_scene(family, slices, kSampleWidth, kSampleHeight)});
    return line;
}

Line line_of(const Family& family, const StudyCurve& curve) {
    Line line{curve.feature, curve.over, curve.effects, {}};
    for (const double number : curve.numbers) {
        // Fine, so that the highlight is seen from many directions; the same points for every number.
        Stop stop{number, sphere_scene(family, 128, kSampleWidth, kSampleHeight)};
        RenderValue value;
        value.name = curve.over;
        value.numbers = {number};
        stop.scene.values.push_back(value);
        stop.scene.identity += fmt::format(" {}={}", curve.over, number);
        line.stops.push_back(std::move(stop));
    }
    return line;
}

/// The most accurate key with one feature at each of its values.
std::vector<std::pair<std::string, Key>> values_along(const Family& family, const Line& line) {
    const Key effects = parse_key(family, line.effects).value();
    std::vector<std::pair<std::string, Key>> keys;
    const int feature = family.index_of(line.feature).value();
    const std::vector<std::string>& values = family.features[static_cast<std::size_t>(feature)].values;
    const int best = most_accurate_value(family.features[static_cast<std::size_t>(feature)]);
    keys.emplace_back(values[static_cast<std::size_t>(best)], most_accurate(family, effects));
    for (Choice& choice : single_choices(family, effects))
        if (choice.feature == feature)
            keys.emplace_back(values[static_cast<std::size_t>(choice.value)], std::move(choice.key));
    return keys;
}

class LineStudy {
  public:
    LineStudy(const Family& family, const Variants& variants, Journal& journal)
        : family_(family), variants_(variants), journal_(journal) {}

    Result<std::vector<CurvePoint>> measure(const Line& line, const Stop& stop) const {
        std::vector<CurvePoint> curve;
        const auto keys = values_along(family_, line);
        const Variant& accurate = variants_.at(keys.front().second);
        std::optional<ScenePoints> points;
        for (const auto& [value, key] : keys) {
            const Variant& variant = variants_.at(key);
            const std::string identity = identity_of_text(
                fmt::format("curve 1 {} {:x} {:x}", stop.scene.identity, variant.hash, accurate.hash));
            auto known = journal_.find(identity);
            if (!known) {
                if (!points) {
                    auto found = find_points(family_, accurate, stop.scene);
                    if (!found) return tl::unexpected(found.error());
                    points = std::move(*found);
                }
                const auto measured = gobo::study::measure(*points, variant, variant);
                if (!measured) return tl::unexpected(measured.error());
                known = nlohmann::json{to_json(measured->approximation), to_json(measured->total)};
                if (auto added = journal_.add(identity, *known); !added) return tl::unexpected(added.error());
            }
            curve.push_back({line.feature, value, line.over, stop.number, line.effects,
                             error_figures_of(known->at(0)).value_or(ErrorFigures{}),
                             error_figures_of(known->at(1)).value_or(ErrorFigures{})});
        }
        return curve;
    }

  private:
    const Family& family_;
    const Variants& variants_;
    Journal& journal_;
};

DrawnScene with_values(DrawnScene scene, const std::vector<RenderValue>& values) {
    scene.values.insert(scene.values.end(), values.begin(), values.end());
    return scene;
}

Result<ChangeResult> measure_change(const Family& family, const SearchPath& search, const DrawnScene& scene,
                                    const StudyChange& change) {
    const Key from = most_accurate(family, parse_key(family, change.from).value());
    const Key to = most_accurate(family, parse_key(family, change.to).value());
    const Result<Variants> variants = load_variants(family, search, {from, to}, 1);
    if (!variants) return tl::unexpected(variants.error());
    auto points = find_points(family, variants->at(from), with_values(scene, change.from_values));
    if (!points) return tl::unexpected(points.error());
    ChangeResult result;
    result.change = change;
    const Colors first = reference_colors(*points);
    for (const auto& colors : first)
        for (const Color& color : colors)
            result.largest = std::max(result.largest, *std::max_element(color.begin(), color.end()));
    points->scene = with_values(scene, change.to_values);
    const auto second = shade_points<double>(*points, variants->at(to));
    if (!second) return tl::unexpected(second.error());
    result.difference = error_between(*points, *second, first);
    return result;
}

}  // namespace

Key at_full_rate(const Family& family, const StudyPlan& plan, const Key& key) {
    Key full = key;
    for (const std::string& name : plan.rate)
        if (const auto feature = family.index_of(name))
            full[static_cast<std::size_t>(*feature)] =
                most_accurate_value(family.features[static_cast<std::size_t>(*feature)]);
    // A feature that the coarser rate left without effect stands at its default there, which need not be the
    // most accurate value.
    const Key accurate = most_accurate(family, key);
    const Key coarse = canonical(family, key, "450");
    for (const int feature : quality_features(family)) {
        const auto i = static_cast<std::size_t>(feature);
        Key accurate_here = coarse;
        accurate_here[i] = accurate[i];
        if (canonical(family, accurate_here, "450") == coarse) full[i] = accurate[i];
    }
    return canonical(family, std::move(full), "450");
}

Result<std::vector<CurvePoint>> measure_curves(const FileSystem& /*shipped*/, const Family& family,
                                               const SearchPath& search, const StudyPlan& plan, bool quick,
                                               int jobs, Journal& journal) {
    std::vector<Line> lines;
    for (const std::string& feature : plan.rate) lines.push_back(tessellation_line(family, plan, feature));
    if (!quick)
        for (const StudyCurve& curve : plan.curves) lines.push_back(line_of(family, curve));
    std::vector<Key> keys;
    std::vector<std::pair<const Line*, const Stop*>> work;
    for (const Line& line : lines) {
        for (const auto& [value, key] : values_along(family, line)) keys.push_back(key);
        for (const Stop& stop : line.stops) work.emplace_back(&line, &stop);
    }
    if (work.empty()) return std::vector<CurvePoint>{};
    const Result<Variants> variants = load_variants(family, search, keys, jobs);
    if (!variants) return tl::unexpected(variants.error());
    const LineStudy study(family, *variants, journal);
    std::vector<Result<std::vector<CurvePoint>>> results(work.size());
    verify::for_each_index(work.size(), jobs, [&](std::size_t i) {
        results[i] = study.measure(*work[i].first, *work[i].second);
    });
    std::vector<CurvePoint> curves;
    for (const auto& result : results) {
        if (!result) return tl::unexpected(result.error());
        curves.insert(curves.end(), result->begin(), result->end());
    }
    return curves;
}

Result<std::vector<ChangeResult>> measure_changes(const FileSystem& shipped, const Family& family,
                                                  const SearchPath& search, const StudyPlan& plan) {
    std::vector<ChangeResult> results;
    if (plan.changes.empty()) return results;
    const Result<DrawnScene> scene = draw_scene(shipped, family, plan.scenes.front());
    if (!scene) return tl::unexpected(scene.error());
    for (const StudyChange& change : plan.changes) {
        Result<ChangeResult> result = measure_change(family, search, *scene, change);
        if (!result) return tl::unexpected(result.error());
        results.push_back(std::move(*result));
    }
    return results;
}

}  // namespace gobo::study
