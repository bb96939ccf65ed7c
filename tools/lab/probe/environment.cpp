#include "lab/probe/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace gobo::probe {
namespace {

tl::unexpected<Diagnostics> fault(const std::string& path, std::string message, std::string help) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = std::move(message);
    diagnostic.help = std::move(help);
    return fail(std::move(diagnostic));
}

/// The latitude of the border above a row, in radians.
double latitude(const Environment& environment, double row) {
    return std::numbers::pi * (0.5 - row / environment.height);
}

tl::unexpected<Diagnostics> no_number(const std::string& path, int column, int row, int channel,
                                      double value) {
    return fault(path,
                 fmt::format("the texel in column {}, row {} (from the upper left, counted from 0) has the "
                             "radiance {} in channel {}",
                             column, row, value, "RGB"[channel]),
                 "radiance is finite: fix the map, or clamp it where it was exported");
}

}  // namespace

glm::dvec3 direction_of(const Environment& environment, int column, int row) {
    const double upwards = latitude(environment, row + 0.5);
    const double around = std::numbers::pi * (1 - 2 * (column + 0.5) / environment.width);
    return {std::cos(upwards) * std::sin(around), std::sin(upwards), std::cos(upwards) * std::cos(around)};
}

double solid_angle(const Environment& environment, int row) {
    const double upper = latitude(environment, row);
    const double lower = latitude(environment, row + 1.0);
    return 2 * std::numbers::pi / environment.width * (std::sin(upper) - std::sin(lower));
}

Result<Environment> environment_of(const Image& image, const std::string& path) {
    if (image.width != 2 * image.height || image.height < 2) {
        return fault(
            path,
            fmt::format("a picture of {} x {} texels is no latitude-longitude map", image.width,
                        image.height),
            "it must be twice as wide as high, and at least 4 x 2: all around, and from zenith to nadir");
    }
    if (image.channels < 3)
        return fault(path, "the picture has no colours", "give one with the channels R, G and B");
    Environment environment{image.width, image.height, {}};
    environment.texels.reserve(static_cast<std::size_t>(image.width) *
                               static_cast<std::size_t>(image.height));
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            glm::dvec3 texel(0);
            for (int channel = 0; channel < 3; ++channel) {
                const double value = image.at(column, row, channel);
                if (!std::isfinite(value)) return no_number(path, column, row, channel, value);
                texel[channel] = std::max(value, 0.0);
                if (value >= 0) continue;
                ++environment.negatives;
                environment.most_negative = std::min(environment.most_negative, value);
            }
            environment.texels.push_back(texel);
        }
    }
    return environment;
}

Environment halved(const Environment& environment) {
    Environment half{environment.width / 2, environment.height / 2, {}};
    half.texels.reserve(environment.texels.size() / 4);
    for (int row = 0; row < half.height; ++row) {
        const double upper = solid_angle(environment, 2 * row);
        const double lower = solid_angle(environment, 2 * row + 1);
        for (int column = 0; column < half.width; ++column) {
            const glm::dvec3 above =
                environment.at(2 * column, 2 * row) + environment.at(2 * column + 1, 2 * row);
            const glm::dvec3 below =
                environment.at(2 * column, 2 * row + 1) + environment.at(2 * column + 1, 2 * row + 1);
            half.texels.push_back((upper * above + lower * below) / (2 * (upper + lower)));
        }
    }
    return half;
}

}  // namespace gobo::probe
