#include "lab/study/error_figures.hpp"

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

}  // namespace

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

double relative_error(const ScenePoints& points, const Colors& actual) {
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

Colors reference_colors(const ScenePoints& points) {
    Colors colors;
    for (const ObjectPoints& part : points.objects) colors.push_back(part.reference);
    return colors;
}

}  // namespace gobo::study
