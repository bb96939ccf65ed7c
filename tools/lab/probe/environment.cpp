#include "lab/probe/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/parallel.hpp"

namespace gobo::probe {
namespace {

/// The latitude of the border above a row, in radians.
double latitude(const Environment& environment, double row) {
    return std::numbers::pi * (0.5 - row / environment.height);
}

constexpr std::array<std::string_view, 9> kNames = {"L00",  "L1m1", "L10", "L11", "L2m2",
                                                    "L2m1", "L20",  "L21", "L22"};

/// The nine real spherical harmonics (equation 3).
std::array<double, 9> basis(const glm::dvec3& w) {
    return {0.282095,
            0.488603 * w.y,
            0.488603 * w.z,
            0.488603 * w.x,
            1.092548 * w.x * w.y,
            1.092548 * w.y * w.z,
            0.315392 * (3 * w.z * w.z - 1),
            1.092548 * w.x * w.z,
            0.546274 * (w.x * w.x - w.y * w.y)};
}

/// The axis of a face, and those along which s and t grow.
struct Face {
    glm::dvec3 axis, s, t;
};

const std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                     {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                     {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                     {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

constexpr int kFewestRows = 128;
constexpr double kRowsToLobe = 6;
/// What is weighed less than this, relative to the lobe's peak, is left out.
constexpr double kLeastWeight = 1e-7;
/// A lobe's table: between its entries a line is off by at most 2e-6 of the peak, at any exponent.
constexpr int kPowers = 4096;

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
        return fail(
            Place{path}, {},
            fmt::format("a picture of {} x {} texels is not a latitude-longitude map", image.width,
                        image.height),
            "it must be twice as wide as high, and at least 4 x 2: all around, and from zenith to nadir");
    }
    if (image.channels < 3)
        return fail(Place{path}, {}, "the picture has no colours", "give one with the channels R, G and B");
    Environment environment{image.width, image.height, {}};
    environment.texels.reserve(static_cast<std::size_t>(image.width) *
                               static_cast<std::size_t>(image.height));
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            glm::dvec3 texel(0);
            for (int channel = 0; channel < 3; ++channel) {
                const double value = image.at(column, row, channel);
                if (!std::isfinite(value))
                    return fail(
                        Place{path}, {},
                        fmt::format("the texel in column {}, row {} (from the upper left, counted from 0) "
                                    "has the radiance {} in channel {}",
                                    column, row, value, "RGB"[channel]),
                        "radiance is finite: fix the map, or clamp it where it was exported");
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

Harmonics project(const Environment& environment) {
    Harmonics harmonics{};
    for (int row = 0; row < environment.height; ++row) {
        const double angle = solid_angle(environment, row);
        for (int column = 0; column < environment.width; ++column) {
            const std::array<double, 9> shares = basis(direction_of(environment, column, row));
            for (std::size_t i = 0; i < 9; ++i)
                harmonics[i] += (angle * shares[i]) * environment.at(column, row);
        }
    }
    return harmonics;
}

std::string to_csv(const Harmonics& harmonics, std::string_view name) {
    std::string text = "probe,coefficient,red,green,blue\n";
    for (std::size_t i = 0; i < 9; ++i)
        text += fmt::format("{},{},{:.6g},{:.6g},{:.6g}\n", name, kNames[i], harmonics[i].r, harmonics[i].g,
                            harmonics[i].b);
    return text;
}

glm::dvec3 cube_direction(int face, int side, int column, int row) {
    const Face& on = kFaces[static_cast<std::size_t>(face)];
    const double s = 2 * (column + 0.5) / side - 1;
    const double t = 2 * (row + 0.5) / side - 1;
    return glm::normalize(on.axis + s * on.s + t * on.t);
}

Image make_cube_map(int side, int jobs, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    Image image(side, 6 * side, 3);
    parallel_for(jobs, static_cast<std::size_t>(image.height), [&](std::size_t i) {
        const int row = static_cast<int>(i);
        for (int column = 0; column < side; ++column) {
            const glm::dvec3 value = radiance(cube_direction(row / side, side, column, row % side));
            for (int channel = 0; channel < 3; ++channel)
                image.at(column, row, channel) = static_cast<float>(value[channel]);
        }
    });
    return image;
}

Lobe::Lobe(const Environment& environment, double exponent)
    : environment_(environment),
      exponent_(exponent),
      least_cosine_(exponent > 1 ? std::pow(kLeastWeight, 1 / exponent) : 0) {
    tabulate(kRowsToLobe * std::numbers::pi * std::sqrt(exponent),
             [=](double cosine) { return std::pow(cosine, exponent); });
}

Lobe::Lobe(const Environment& environment, double width, double least_cosine,
           const std::function<double(double)>& shape)
    : environment_(environment), exponent_(0), least_cosine_(least_cosine) {
    tabulate(kRowsToLobe * std::numbers::pi / width, shape);
}

void Lobe::tabulate(double needed_rows, const std::function<double(double)>& shape) {
    for (int i = 0; i <= kPowers; ++i)
        powers_.push_back(shape(least_cosine_ + (1 - least_cosine_) * i / kPowers));
    powers_.push_back(powers_.back());  // a cosine may be a rounding above 1
    const double needed = std::max<double>(kFewestRows, needed_rows);
    while (environment_.height >= 2 * needed && environment_.height % 2 == 0)
        environment_ = halved(environment_);
    for (int row = 0; row < environment_.height; ++row) {
        const glm::dvec3 direction = direction_of(environment_, 0, row);
        rows_.push_back({solid_angle(environment_, row), direction.y, std::hypot(direction.x, direction.z)});
    }
    for (int column = 0; column < environment_.width; ++column) {
        const double around = std::numbers::pi * (1 - 2 * (column + 0.5) / environment_.width);
        sines_.push_back(std::sin(around));
        cosines_.push_back(std::cos(around));
    }
}

double Lobe::weight(double cosine) const {
    const double at = (cosine - least_cosine_) / (1 - least_cosine_) * kPowers;
    const auto entry = static_cast<std::size_t>(std::min(at, static_cast<double>(kPowers)));
    return powers_[entry] + (at - static_cast<double>(entry)) * (powers_[entry + 1] - powers_[entry]);
}

glm::dvec3 Lobe::around(const glm::dvec3& direction) const {
    const double level = std::hypot(direction.x, direction.z);
    glm::dvec3 sum(0);
    double weights = 0;
    for (int row = 0; row < environment_.height; ++row) {
        const Row& one = rows_[static_cast<std::size_t>(row)];
        const double most = direction.y * one.sine + level * one.cosine;  // the largest cosine in the row
        if (most <= least_cosine_) continue;
        for (int column = 0; column < environment_.width; ++column) {
            const auto i = static_cast<std::size_t>(column);
            const double cosine =
                direction.y * one.sine + one.cosine * (direction.x * sines_[i] + direction.z * cosines_[i]);
            if (cosine <= least_cosine_) continue;
            const double weighted = one.solid_angle * (exponent_ == 1 ? cosine : weight(cosine));
            weights += weighted;
            sum += weighted * environment_.at(column, row);
        }
    }
    return weights > 0 ? sum / weights : nearest(direction);
}

glm::dvec3 Lobe::nearest(const glm::dvec3& direction) const {
    const double down = std::acos(std::clamp(direction.y, -1.0, 1.0)) / std::numbers::pi;
    const double along = (1 - std::atan2(direction.x, direction.z) / std::numbers::pi) / 2;
    const int row = static_cast<int>(down * environment_.height);
    const int column = static_cast<int>(along * environment_.width);
    return environment_.at(std::min(column, environment_.width - 1), std::min(row, environment_.height - 1));
}

std::vector<Image> roughness_maps(const Environment& environment, int side, int levels, int jobs) {
    std::vector<Image> maps;
    for (int level = 0; level < levels; ++level, side /= 2) {
        const double roughness = levels > 1 ? static_cast<double>(level) / (levels - 1) : 0;
        // A lobe narrower than the first level's texels shows one of them.
        const double alpha = std::max(roughness * roughness, 1.0 / side);
        const auto shape = [=](double cosine) {
            const double half_cosine_squared = (1 + cosine) / 2;
            const double spread = (alpha * alpha - 1) * half_cosine_squared + 1;
            return cosine / (spread * spread);
        };
        double least = 1;  // up to where the lobe has fallen to 1e-4 of its peak
        while (least > 0 && shape(least) > 1e-4 * shape(1)) least -= 1e-3;
        const Lobe lobe(environment, alpha, std::max(least, 0.0), shape);
        maps.push_back(make_cube_map(std::max(side, 1), jobs,
                                     [&](const glm::dvec3& direction) { return lobe.around(direction); }));
    }
    return maps;
}

Image lobe_map(const Environment& environment, double exponent, int side, int jobs) {
    const Lobe lobe(environment, exponent);
    return make_cube_map(side, jobs, [&](const glm::dvec3& direction) { return lobe.around(direction); });
}

}  // namespace gobo::probe
