#include "lit_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace gobo {
namespace {

std::string differs(const Shaded& ours, const std::array<double, 4>& wanted, double tolerance) {
    for (std::size_t i = 0; i < 4; ++i)
        if (!(std::abs(ours.color[i] - wanted[i]) <= tolerance * std::abs(wanted[i])))
            return fmt::format("channel {} is {}, should be {} within {:g} of it", i, ours.color[i],
                               wanted[i], tolerance);
    return {};
}

}  // namespace

Inputs with(Inputs inputs, const Inputs& changes) {
    for (const auto& [name, numbers] : changes) inputs[name] = numbers;
    return inputs;
}

Check robust() {
    return {[](const Trial&) { return std::string(); }, "finite, not negative"};
}

Check same_as(const Inputs& changes, double tolerance) {
    return {[=](const Trial& trial) {
                const Shaded other =
                    trial.lit.shade_unwatched(trial.permutation, with(trial.inputs, changes), trial.mode);
                return differs(trial.shaded, other.color, tolerance);
            },
            tolerance == 0 ? "exact" : fmt::format("{:g} of it", tolerance)};
}

Check is_color(const std::array<double, 4>& color) {
    return {[=](const Trial& trial) { return differs(trial.shaded, color, 0); }, "exact"};
}

Check near_double(double tolerance) {
    return {[=](const Trial& trial) {
                const Shaded exact = trial.lit.shade_unwatched(trial.permutation, trial.inputs, kDouble);
                return differs(trial.shaded, exact.color, tolerance);
            },
            fmt::format("{:g} of it", tolerance)};
}

namespace {

std::string band_fault(const Trial& trial) {
    const double cosine = trial.inputs.at("DirectionalLights.lights[].direction")[2];
    const double upper = std::round(cosine * 4) / 4;
    const double tone = trial.shaded.color[0];
    if (tone == std::min(upper, 0.75) || tone == upper - 0.25) return {};
    return fmt::format("the tone {} is none of the two bands at a cosine of {}", tone, cosine);
}

std::string ceil_band_fault(const Trial& trial) {
    const double cosine = trial.inputs.at("DirectionalLights.lights[].direction")[2];
    const double lower = std::round(cosine * 4) / 4;
    const double tone = trial.shaded.color[0];
    if (tone == lower || tone == std::min(lower + 0.25, 1.0)) return {};
    return fmt::format("the tone {} is none of the two bands at a cosine of {}", tone, cosine);
}

std::string tone_fault(const Trial& trial) {
    // From below: no tone, then those of ordinary inputs, each above its threshold.
    constexpr std::array<double, 3> kThresholds = {0.25, 0.5, 0.95};
    constexpr std::array<double, 4> kTones = {0, 0.375, 0.625, 1};
    const double cosine = trial.inputs.at("DirectionalLights.lights[].direction")[2];
    const double tone = trial.shaded.color[0];
    for (std::size_t i = 0; i < kThresholds.size(); ++i)
        if (std::abs(cosine - kThresholds[i]) < 1e-6 && (tone == kTones[i] || tone == kTones[i + 1]))
            return {};
    return fmt::format("the tone {} is none of the two at a cosine of {}", tone, cosine);
}

/// What rounding the directions alone costs: 2 sqrt(m) 2^-24 / |s + v| of a white highlight, |s + v| being 2
/// here. The angle to a mirrored ray is twice that to a half vector, so Phong's m counts four times.
std::string sharpness_fault(const Trial& trial) {
    const double exact = trial.lit.shade_unwatched(trial.permutation, trial.inputs, kDouble).color[0];
    const double shininess = trial.inputs.at("Material.shininess")[0];
    const bool is_phong = trial.lit.key(trial.permutation).find("specular=phong") != std::string::npos;
    const double limit = std::sqrt(shininess * (is_phong ? 4 : 1)) * 0x1p-24;
    const double error = std::abs(trial.shaded.color[0] - exact);
    if (error <= limit + 0x1p-24) return {};  // and half a rounding of the result
    return fmt::format("the highlight is {}, off by {:.2e}, more than {:.2e}", exact, error, limit);
}

/// As IEEE 754 converts to binary16, rounding to nearest even: 11 bits, exponents from -14 to 15.
double half_float(double number) {
    if (number >= 65520) return std::numeric_limits<double>::infinity();
    const int exponent = std::max(std::ilogb(number), -14);
    const double step = std::ldexp(1.0, exponent - 10);
    return std::nearbyint(number / step) * step;
}

std::string half_float_fault(const Trial& trial) {
    const std::array<double, 4> exact =
        trial.lit.shade_unwatched(trial.permutation, trial.inputs, kDouble).color;
    for (std::size_t i = 0; i < 4; ++i) {
        const double stored = half_float(trial.shaded.color[i]);
        // Half a step of the 16-bit float, and the roundings on the way there.
        const double tolerance = exact[i] * (0x1p-11 + 1e-5) + 0x1p-25;
        if (!(stored <= 65504) || !(std::abs(stored - exact[i]) <= tolerance))
            return fmt::format("channel {} is {}, stored as {}, should be {}", i, trial.shaded.color[i],
                               stored, exact[i]);
    }
    return {};
}

std::string display_fault(const Trial& trial) {
    const std::array<double, 4> exact =
        trial.lit.shade_unwatched(trial.permutation, trial.inputs, kDouble).color;
    for (std::size_t i = 0; i < 4; ++i)
        if (!(trial.shaded.color[i] <= 1) || !(std::abs(trial.shaded.color[i] - exact[i]) <= 1e-5))
            return fmt::format("channel {} is {}, should be {}", i, trial.shaded.color[i], exact[i]);
    return {};
}

std::string depth_fault(const Trial& trial) {
    if (!trial.shaded.depth) return "no depth is written";
    const double written = *trial.shaded.depth;
    const double own = static_cast<float>(trial.inputs.at("gl_FragCoord")[2]);
    const std::string key = trial.lit.key(trial.permutation);
    const bool is_kept = (key != "depth=greater" || written >= own) &&
                         (key != "depth=less" || written <= own) &&
                         (key != "depth=unchanged" || written == own);
    if (is_kept && written >= 0 && written <= 1) return {};
    return fmt::format("the depth {} is written over {}", written, own);
}

}  // namespace

Check is_neighbouring_band() {
    return {band_fault, "one of the two bands"};
}

Check is_neighbouring_band_of_ceil() {
    return {ceil_band_fault, "one of the two bands"};
}

Check is_neighbouring_tone() {
    return {tone_fault, "one of the two tones"};
}

Check is_there(bool expected) {
    return {[=](const Trial& trial) {
                if (trial.shaded.is_discarded != expected) return std::string();
                return std::string(expected ? "the fragment is discarded" : "the fragment is not discarded");
            },
            expected ? "drawn" : "discarded"};
}

Check is_sharp_to_rounding() {
    return {sharpness_fault, "2 sqrt(m) 2^-24 / |s + v|"};
}

Check fits_half_float() {
    return {half_float_fault, "half a step of the 16-bit float, at most 65504"};
}

Check fits_display() {
    return {display_fault, "1e-05, at most 1"};
}

Check keeps_depth_promise() {
    return {depth_fault, "in [0, 1], the promised side exactly"};
}

}  // namespace gobo
