#include "lab/study/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    measurement.pixels = points.pixels;
    measurement.edges = points.edges;
    measurement.shown_vertices = points.shown_vertices;
    measurement.mesh_vertices = points.mesh_vertices;
    measurement.from_oracle = points.from_oracle;
    return measurement;
}

}  // namespace gobo::study
