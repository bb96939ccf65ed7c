#include "lab/probe/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gobo::probe {
namespace {

constexpr int kFewestRows = 128;
constexpr double kRowsToLobe = 6;
/// What is weighed less than this, relative to the lobe's peak, is left out.
constexpr double kLeastWeight = 1e-7;
/// A lobe's table: between its entries a line is off by at most 2e-6 of the peak, at any exponent.
constexpr int kPowers = 4096;

}  // namespace

Lobe::Lobe(const Environment& environment, double exponent)
    : environment_(environment),
      exponent_(exponent),
      least_cosine_(exponent > 1 ? std::pow(kLeastWeight, 1 / exponent) : 0) {
    for (int i = 0; i <= kPowers; ++i)
        powers_.push_back(std::pow(least_cosine_ + (1 - least_cosine_) * i / kPowers, exponent));
    powers_.push_back(powers_.back());  // a cosine may be a rounding above 1
    const double needed = std::max<double>(kFewestRows, kRowsToLobe * std::numbers::pi * std::sqrt(exponent));
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
    return weights > 0 ? sum / weights : sum;
}

}  // namespace gobo::probe
