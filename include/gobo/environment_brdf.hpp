// The table that `environment_brdf=table` of the family `pbr` looks up: what a surface mirrors of an even
// environment. C++17.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gobo {

/// A and B of A f0 + B f90, each 0 to 1.
struct EnvironmentBrdf {
    double a = 0;
    double b = 0;
};

/// The integral of D V n.l over all lights, parted by Schlick's Fresnel: A of 1 - (1 - l.h)^5, B of
/// (1 - l.h)^5, with Trowbridge and Reitz's D and Smith's V, correlated by height, as the shaders have them
/// by default. `nv` is the cosine to the viewer, above 0 and up to 1, `roughness` as it is perceived, 0 to 1.
/// It is the mean over half vectors as frequent as D has them, on a grid of `grid` by `grid`: 64 is within
/// 2.5e-3 of a grid of 512 at n.v = 1/64, within 1e-3 from 0.1 on.
/// Source: Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course notes; Heitz, JCGT 3 (2014), eq. 99.
inline EnvironmentBrdf environment_brdf(double nv, double roughness, int grid = 64) {
    constexpr double pi = 3.14159265358979323846;
    const double alpha = (std::max)(roughness * roughness, 0.002);  // as the shaders bound it
    const double square = alpha * alpha;
    const double view_x = std::sqrt((std::max)(1 - nv * nv, 0.0));
    EnvironmentBrdf sum;
    for (int i = 0; i < grid; ++i) {
        const double left = (i + 0.5) / grid;  // close together where n.h nears 0, by which is divided
        const double u = 1 - left * left;
        const double nh = std::sqrt((1 - u) / (1 + (square - 1) * u));
        const double sine = std::sqrt((std::max)(1 - nh * nh, 0.0));
        for (int j = 0; j < grid; ++j) {  // the other half is its mirror image
            const double azimuth = pi * (j + 0.5) / grid;
            const double vh = view_x * sine * std::cos(azimuth) + nv * nh;
            const double nl = 2 * vh * nh - nv;
            if (nl <= 0 || vh <= 0) continue;
            const double visibility = 0.5 / (nl * std::sqrt(square + (1 - square) * nv * nv) +
                                             nv * std::sqrt(square + (1 - square) * nl * nl));
            const double weight = 2 * left * 4 * visibility * nl * vh / nh;
            const double fresnel = std::pow((std::max)(1 - vh, 0.0), 5);
            sum.a += weight * (1 - fresnel);
            sum.b += weight * fresnel;
        }
    }
    const double count = static_cast<double>(grid) * grid;
    return {(std::min)(sum.a / count, 1.0), (std::min)(sum.b / count, 1.0)};
}

/// The texels of the sampler `environmentBrdfTable`: A and B of each, n.v along a row, roughness from row to
/// row, at the texels' middles. `size` texels a side, 32 or more. To be uploaded as GL_RG, GL_FLOAT into
/// GL_RG16F (not GL_RG8: 8 bits show).
inline std::vector<float> environment_brdf_table(int size = 32, int grid = 64) {
    std::vector<float> texels;
    texels.reserve(2 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const EnvironmentBrdf brdf = environment_brdf((column + 0.5) / size, (row + 0.5) / size, grid);
            texels.push_back(static_cast<float>(brdf.a));
            texels.push_back(static_cast<float>(brdf.b));
        }
    return texels;
}

}  // namespace gobo
