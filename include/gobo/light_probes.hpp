// Light of whole environments as coefficients of spherical harmonics, for the block `Harmonics` of family
// lit: ten measured probes, and what an application may ask about any probe.
//
// Sources: the numbers are those published in the OpenGL Shading Language book, 2nd ed., table 12.1, and the
// OpenGL Programming Guide, 9th ed., ch. 7, of light probes by Paul Debevec and Bernhard Vogl; the polynomial
// is equation 13 of Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps,
// SIGGRAPH 2001.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace gobo {

/// Red, green and blue of the coefficients L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22, radiance of any
/// unit.
using LightProbe = std::array<std::array<float, 3>, 9>;

/// A probe that was measured.
struct NamedLightProbe {
    std::string_view name;
    LightProbe coefficients;
};

// clang-format off
/// The ten published probes, y up.
inline constexpr std::array<NamedLightProbe, 10> light_probes = {{
    {"Breezeway",
     {{
         {0.32F, 0.36F, 0.38F},  // L00
         {0.37F, 0.41F, 0.45F},  // L1-1
         {-0.01F, -0.01F, -0.01F},  // L10
         {-0.10F, -0.12F, -0.12F},  // L11
         {-0.13F, -0.15F, -0.17F},  // L2-2
         {-0.01F, -0.02F, 0.02F},  // L2-1
         {-0.07F, -0.08F, -0.09F},  // L20
         {0.02F, 0.03F, 0.03F},  // L21
         {-0.29F, -0.32F, -0.36F},  // L22
     }}},
    {"Campus Sunset",
     {{
         {0.79F, 0.94F, 0.98F},  // L00
         {0.44F, 0.56F, 0.70F},  // L1-1
         {-0.10F, -0.18F, -0.27F},  // L10
         {0.45F, 0.38F, 0.20F},  // L11
         {0.18F, 0.14F, 0.05F},  // L2-2
         {-0.14F, -0.22F, -0.31F},  // L2-1
         {-0.39F, -0.40F, -0.36F},  // L20
         {0.09F, 0.07F, 0.04F},  // L21
         {0.67F, 0.67F, 0.52F},  // L22
     }}},
    {"Eucalyptus Grove",
     {{
         {0.38F, 0.43F, 0.45F},  // L00
         {0.29F, 0.36F, 0.41F},  // L1-1
         {0.04F, 0.03F, 0.01F},  // L10
         {-0.10F, -0.10F, -0.09F},  // L11
         {-0.06F, -0.06F, -0.04F},  // L2-2
         {0.01F, -0.01F, -0.05F},  // L2-1
         {-0.09F, -0.13F, -0.15F},  // L20
         {-0.06F, -0.05F, -0.04F},  // L21
         {0.02F, 0.00F, -0.05F},  // L22
     }}},
    {"Funston Beach Sunset",
     {{
         {0.68F, 0.69F, 0.70F},  // L00
         {0.32F, 0.37F, 0.44F},  // L1-1
         {-0.17F, -0.17F, -0.17F},  // L10
         {-0.45F, -0.42F, -0.34F},  // L11
         {-0.17F, -0.17F, -0.15F},  // L2-2
         {-0.08F, -0.09F, -0.10F},  // L2-1
         {-0.03F, -0.02F, -0.01F},  // L20
         {0.16F, 0.14F, 0.10F},  // L21
         {0.37F, 0.31F, 0.20F},  // L22
     }}},
    {"Galileo's Tomb",
     {{
         {1.04F, 0.76F, 0.71F},  // L00
         {0.44F, 0.34F, 0.34F},  // L1-1
         {-0.22F, -0.18F, -0.17F},  // L10
         {0.71F, 0.54F, 0.56F},  // L11
         {0.64F, 0.50F, 0.52F},  // L2-2
         {-0.12F, -0.09F, -0.08F},  // L2-1
         {-0.37F, -0.28F, -0.29F},  // L20
         {-0.17F, -0.13F, -0.13F},  // L21
         {0.55F, 0.42F, 0.42F},  // L22
     }}},
    {"Grace Cathedral",
     {{
         {0.79F, 0.44F, 0.54F},  // L00
         {0.39F, 0.35F, 0.60F},  // L1-1
         {-0.34F, -0.18F, -0.27F},  // L10
         {-0.29F, -0.06F, 0.01F},  // L11
         {-0.11F, -0.05F, -0.12F},  // L2-2
         {-0.26F, -0.22F, -0.47F},  // L2-1
         {-0.16F, -0.09F, -0.15F},  // L20
         {0.56F, 0.21F, 0.14F},  // L21
         {0.21F, -0.05F, -0.30F},  // L22
     }}},
    {"Old Town Square",
     {{
         {0.87F, 0.88F, 0.86F},  // L00
         {0.18F, 0.25F, 0.31F},  // L1-1
         {0.03F, 0.04F, 0.04F},  // L10
         {0.00F, -0.03F, -0.05F},  // L11
         {-0.12F, -0.12F, -0.12F},  // L2-2
         {0.00F, 0.00F, 0.01F},  // L2-1
         {-0.03F, -0.02F, -0.02F},  // L20
         {-0.08F, -0.09F, -0.09F},  // L21
         {-0.16F, -0.19F, -0.22F},  // L22
     }}},
    {"St. Peter's Basilica",
     {{
         {0.36F, 0.26F, 0.23F},  // L00
         {0.18F, 0.14F, 0.13F},  // L1-1
         {-0.02F, -0.01F, 0.00F},  // L10
         {0.03F, 0.02F, 0.00F},  // L11
         {0.02F, 0.01F, 0.00F},  // L2-2
         {-0.05F, -0.03F, -0.01F},  // L2-1
         {-0.09F, -0.08F, -0.07F},  // L20
         {0.01F, 0.00F, 0.00F},  // L21
         {-0.08F, -0.03F, 0.00F},  // L22
     }}},
    {"Uffizi Gallery",
     {{
         {0.32F, 0.31F, 0.35F},  // L00
         {0.37F, 0.37F, 0.43F},  // L1-1
         {0.00F, 0.00F, 0.00F},  // L10
         {-0.01F, -0.01F, -0.01F},  // L11
         {-0.02F, -0.02F, -0.03F},  // L2-2
         {-0.01F, -0.01F, -0.01F},  // L2-1
         {-0.28F, -0.28F, -0.32F},  // L20
         {0.00F, 0.00F, 0.00F},  // L21
         {-0.24F, -0.24F, -0.28F},  // L22
     }}},
    {"Vine Street Kitchen",
     {{
         {0.64F, 0.67F, 0.73F},  // L00
         {0.28F, 0.32F, 0.33F},  // L1-1
         {0.42F, 0.60F, 0.77F},  // L10
         {-0.05F, -0.04F, -0.02F},  // L11
         {-0.10F, -0.08F, -0.05F},  // L2-2
         {0.25F, 0.39F, 0.53F},  // L2-1
         {0.38F, 0.54F, 0.71F},  // L20
         {0.06F, 0.01F, -0.02F},  // L21
         {-0.03F, -0.02F, -0.03F},  // L22
     }}},
}};
// clang-format on

/// The irradiance that a surface facing the unit vector (x, y, z) gets of the probe, per channel, up to
/// second order. Around one small bright light it is negative on the far side.
inline std::array<double, 3> irradiance(const LightProbe& probe, double x, double y, double z) {
    const std::array<double, 9> factors = {0.886227,
                                           1.023328 * y,
                                           1.023328 * z,
                                           1.023328 * x,
                                           0.858086 * x * y,
                                           0.858086 * y * z,
                                           0.743125 * z * z - 0.247708,
                                           0.858086 * x * z,
                                           0.429043 * (x * x - y * y)};
    std::array<double, 3> sum = {0, 0, 0};
    for (std::size_t term = 0; term < factors.size(); ++term)
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += factors[term] * static_cast<double>(probe[term][channel]);
    return sum;
}

/// What clamping the irradiance to 0, as the shaders do, adds to the probe's energy: the mean over all
/// directions of max(E, 0) - E, relative to the mean of E, per channel; 0 for a probe that is nowhere
/// negative, and for one without light. Measured at 16,384 directions spread evenly: good to 1e-3 of the
/// result's scale.
inline std::array<double, 3> energy_added_by_clamping(const LightProbe& probe) {
    constexpr int directions = 16384;
    std::array<double, 3> added = {0, 0, 0};
    std::array<double, 3> whole = {0, 0, 0};
    for (int i = 0; i < directions; ++i) {  // a spiral whose turns are as far apart as its points
        const double z = 1 - (2 * i + 1.0) / directions;
        const double radius = std::sqrt(1 - z * z);
        const double turn = 2.399963229728653 * i;  // the golden angle
        const std::array<double, 3> here =
            irradiance(probe, radius * std::cos(turn), radius * std::sin(turn), z);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            whole[channel] += here[channel];
            if (here[channel] < 0) added[channel] -= here[channel];
        }
    }
    for (std::size_t channel = 0; channel < 3; ++channel)
        added[channel] = whole[channel] > 0 ? added[channel] / whole[channel] : 0;
    return added;
}

}  // namespace gobo
