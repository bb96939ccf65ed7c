#include "lab/study/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/text.hpp"

namespace gobo::study {
namespace {

double distance(double actual, double expected) {
    if (actual == expected) return 0;
    const double error = std::abs(actual - expected);
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

/// The largest relative error against the reference, where that exceeds a radiance below which it says
/// nothing.
double relative_error(const ScenePoints& points, const Colors& actual) {
    constexpr double kLeastRadiance = 1e-3;
    double largest = 0;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        const ObjectPoints& part = points.objects[o];
        for (std::size_t i = 0; i < part.fragments.size(); ++i) {
            for (std::size_t c = 0; c < 3 && !part.at_edge[i]; ++c) {
                const double expected = part.reference[i][c];
                if (expected > kLeastRadiance)
                    largest = std::max(largest, distance(actual[o][i][c], expected) / expected);
            }
        }
    }
    return largest;
}

Weights& of_renderer(std::vector<Weights>& all, const std::string& renderer) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Weights& one) { return one.renderer == renderer; });
    if (found != all.end()) return *found;
    all.push_back({renderer, 0, {}});
    return all.back();
}

}  // namespace

Colors reference_colors(const ScenePoints& points) {
    Colors colors;
    for (const ObjectPoints& part : points.objects) colors.push_back(part.reference);
    return colors;
}

ErrorFigures error_between(const ScenePoints& points, const Colors& actual, const Colors& expected) {
    std::vector<double> largest;
    double squares = 0;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        for (std::size_t i = 0; i < points.objects[o].fragments.size(); ++i) {
            if (points.objects[o].at_edge[i]) continue;
            double worst = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double error = distance(actual[o][i][c], expected[o][i][c]);
                worst = std::max(worst, error);
                squares += error * error;
            }
            largest.push_back(worst);
        }
    }
    if (largest.empty()) return {};
    std::sort(largest.begin(), largest.end());
    const auto rank = static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(largest.size())));
    return {largest.back(), largest[rank - 1],
            std::sqrt(squares / (3 * static_cast<double>(largest.size())))};
}

template <class T>
Result<Colors> shade_points(const ScenePoints& points, const Variant& variant, raster::Work* work) {
    Colors colors;
    for (const ObjectPoints& part : points.objects) {
        std::vector<Color>& of_object = colors.emplace_back();
        if (part.fragments.empty()) continue;
        GOBO_TRY(const raster::RasterObject object, shaded_object(variant, points.scene, part));
        GOBO_TRY(const auto shaded, raster::shade<T>(variant.program, object, work));
        for (const raster::Shaded& one : shaded)
            of_object.push_back(one.is_discarded ? Color{} : Color{one.color[0], one.color[1], one.color[2]});
    }
    return colors;
}

template Result<Colors> shade_points<float>(const ScenePoints&, const Variant&, raster::Work*);
template Result<Colors> shade_points<double>(const ScenePoints&, const Variant&, raster::Work*);

Result<Measurement> measure(const ScenePoints& points, const Variant& variant, const Variant& at_full_rate) {
    Measurement measurement;
    static_cast<PointCounts&>(measurement) = points;
    GOBO_TRY(const Colors in_float, shade_points<float>(points, variant, &measurement.work));
    GOBO_TRY(const Colors in_double, shade_points<double>(points, variant));
    Colors full_rate = in_double;
    if (&variant != &at_full_rate) {
        GOBO_TRY(full_rate, shade_points<double>(points, at_full_rate));
    }
    const Colors reference = reference_colors(points);
    measurement.total = error_between(points, in_float, reference);
    measurement.rounding = error_between(points, in_float, in_double);
    measurement.approximation = error_between(points, full_rate, reference);
    measurement.rate = error_between(points, in_double, full_rate);
    measurement.relative = relative_error(points, in_float);
    return measurement;
}

Result<std::vector<Weights>> read_weights(std::string_view csv, const std::string& path) {
    const auto problem = [&](std::size_t row, std::string message) {
        return fail_at_row(path, row, std::move(message),
                           "remake the weights: gobo study lit --weights -o FOLDER");
    };
    const CsvTable table = read_csv(csv);
    const auto renderer = table.column("renderer");
    const auto kind = table.column("kind");
    const auto weight = table.column("weight");
    const auto nanoseconds = table.column("nanoseconds");
    if (!renderer || !kind || !weight || !nanoseconds || table.rows.empty())
        return problem(0, "not a table of weights: renderer, kind, weight, nanoseconds");
    std::vector<Weights> all;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const std::vector<std::string>& row = table.rows[i];
        const auto at = std::find(evaluate::kKindNames.begin(), evaluate::kKindNames.end(), row[*kind]);
        const std::optional<double> number = number_from<double>(row[*weight]);
        const std::optional<double> time = number_from<double>(row[*nanoseconds]);
        if (at == evaluate::kKindNames.end())
            return problem(i, fmt::format("there is no kind of operation '{}'", row[*kind]));
        if (!number || *number < 0 || !time)
            return problem(i, fmt::format("'{}' is not a weight", row[*weight]));
        Weights& weights = of_renderer(all, row[*renderer]);
        weights.by_kind[static_cast<std::size_t>(at - evaluate::kKindNames.begin())] = *number;
        if (*number > 0) weights.nanoseconds = *time / *number;
    }
    return all;
}

std::string weights_csv(const std::vector<Weights>& weights) {
    CsvTable table{{"renderer", "kind", "weight", "nanoseconds"}, {}};
    for (const Weights& one : weights)
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            table.rows.push_back({one.renderer, std::string(evaluate::kKindNames[kind]),
                                  fmt::format("{:.3g}", one.by_kind[kind]),
                                  fmt::format("{:.3g}", one.by_kind[kind] * one.nanoseconds)});
    return csv_text(table);
}

double weighted(const evaluate::Counts& counts, const Weights& weights) {
    double sum = 0;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        sum += weights.by_kind[kind] * static_cast<double>(counts[kind]);
    return sum;
}

Costs costs_of(const Measurement& measurement, const Weights& weights) {
    constexpr double kEnlargement =
        static_cast<double>(kFullWidth) * kFullHeight / (static_cast<double>(kSampleWidth) * kSampleHeight);
    const auto pixels = static_cast<double>(measurement.pixels);
    const auto vertices = static_cast<double>(std::max<std::size_t>(measurement.shown_vertices, 1));
    Costs costs;
    costs.fragment = weighted(measurement.work.fragments, weights) / pixels;
    costs.vertex = weighted(measurement.work.vertices, weights) / vertices;
    costs.vertices_per_fragment = static_cast<double>(measurement.mesh_vertices) / (pixels * kEnlargement);
    costs.total = costs.fragment + costs.vertex * costs.vertices_per_fragment;
    return costs;
}

}  // namespace gobo::study
