#include "image_comparison.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gobo {
namespace {

PixelDifference pixel_difference(const Image& first, const Image& second, int x, int y) {
    PixelDifference pixel;
    pixel.x = x;
    pixel.y = y;
    for (int channel = 0; channel < first.channels; ++channel) {
        pixel.first.push_back(first.at(x, y, channel));
        pixel.second.push_back(second.at(x, y, channel));
        pixel.difference =
            std::max(pixel.difference, absolute_difference(pixel.first.back(), pixel.second.back()));
    }
    return pixel;
}

std::vector<PixelDifference> worst_pixels(const Image& first, const Image& second, std::size_t count) {
    std::vector<PixelDifference> pixels;
    for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
            PixelDifference pixel = pixel_difference(first, second, x, y);
            if (pixel.difference > 0) pixels.push_back(std::move(pixel));
        }
    }
    std::stable_sort(pixels.begin(), pixels.end(),
                     [](const auto& left, const auto& right) { return left.difference > right.difference; });
    pixels.resize(std::min(pixels.size(), count));
    return pixels;
}

}  // namespace

Result<Comparison> compare(const Image& first, const Image& second, std::size_t worst_count) {
    if (first.width != second.width || first.height != second.height || first.channels != second.channels)
        return fail(Fault::input,
                    fmt::format("pictures of {} x {} x {} and {} x {} x {} cannot be compared", first.width,
                                first.height, first.channels, second.width, second.height, second.channels));
    Comparison comparison;
    if (first.values.empty()) return comparison;
    std::vector<double> differences;
    double squares = 0;
    for (std::size_t i = 0; i < first.values.size(); ++i) {
        differences.push_back(absolute_difference(first.values[i], second.values[i]));
        squares += differences.back() * differences.back();
    }
    std::sort(differences.begin(), differences.end());
    const auto count = static_cast<double>(differences.size());
    comparison.largest = differences.back();
    comparison.percentile_999 = differences[static_cast<std::size_t>(std::ceil(0.999 * count)) - 1];
    comparison.root_mean_square = std::sqrt(squares / count);
    comparison.worst = worst_pixels(first, second, worst_count);
    return comparison;
}

std::string to_text(const Comparison& comparison) {
    std::string text =
        fmt::format("largest {:.9g}, 99.9th percentile {:.9g}, RMSE {:.9g}\n", comparison.largest,
                    comparison.percentile_999, comparison.root_mean_square);
    for (const PixelDifference& pixel : comparison.worst)
        text += fmt::format("  ({}, {}): {:.9g} against {:.9g}, {:.9g} apart\n", pixel.x, pixel.y,
                            fmt::join(pixel.first, " "), fmt::join(pixel.second, " "), pixel.difference);
    return text;
}

}  // namespace gobo
