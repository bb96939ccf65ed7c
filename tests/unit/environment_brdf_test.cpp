// The table of the environment BRDF against closed forms, and against the integral over the lights
// themselves.
#include <cmath>

#include <gobo/environment_brdf.hpp>
#include <gtest/gtest.h>

namespace gobo {
namespace {

/// D V n.l and Schlick's weight over all directions of the light, by latitude and longitude.
EnvironmentBrdf over_lights(double nv, double alpha) {
    constexpr int kSteps = 600;
    const double pi = std::acos(-1.0);
    const double sv = std::sqrt(1 - nv * nv);
    EnvironmentBrdf sum;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double nl = (i + 0.5) / kSteps;
            const double phi = pi * (j + 0.5) / kSteps;
            const double lv = std::sqrt(1 - nl * nl) * sv * std::cos(phi) + nl * nv;
            const double length = std::sqrt(2 + 2 * lv);
            const double nh = (nl + nv) / length;
            const double d = std::pow(alpha / (nh * nh * (alpha * alpha - 1) + 1), 2) / pi;
            const auto lambda = [&](double c) {
                return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2;
            };
            const double g = 1 / (1 + lambda(nl) + lambda(nv));
            const double reflected = d * g / (4 * nv) * (2 * pi / kSteps / kSteps);
            const double fresnel = std::pow(1 - length / 2, 5);
            sum.a += reflected * (1 - fresnel);
            sum.b += reflected * fresnel;
        }
    return sum;
}

TEST(EnvironmentBrdf, OfRoughnessOneIsTheClosedForm) {
    // D is 1 / pi and V 1 / (2 (n.l + n.v)): the integral of x / (x + n.v) from 0 to 1.
    for (const double nv : {0.05, 0.25, 0.5, 1.0}) {
        const EnvironmentBrdf brdf = environment_brdf(nv, 1);
        EXPECT_NEAR(brdf.a + brdf.b, 1 - nv * std::log(1 + 1 / nv), 1e-3) << nv;
    }
}

TEST(EnvironmentBrdf, OfAMirrorIsSchlicks) {
    for (const double nv : {0.25, 0.5, 1.0}) {
        const EnvironmentBrdf brdf = environment_brdf(nv, 0);
        EXPECT_NEAR(brdf.b, std::pow(1 - nv, 5), 1e-3) << nv;
        EXPECT_NEAR(brdf.a, 1 - std::pow(1 - nv, 5), 1e-3) << nv;
    }
}

TEST(EnvironmentBrdf, IsTheIntegralOverTheLights) {
    for (const double nv : {0.1, 0.4, 0.9})
        for (const double roughness : {0.5, 0.7, 0.9}) {
            const EnvironmentBrdf brdf = environment_brdf(nv, roughness);
            const EnvironmentBrdf lights = over_lights(nv, roughness * roughness);
            EXPECT_NEAR(brdf.a, lights.a, 1e-3) << nv << ' ' << roughness;
            EXPECT_NEAR(brdf.b, lights.b, 1e-3) << nv << ' ' << roughness;
        }
}

TEST(EnvironmentBrdf, TableIsByCosineAlongRowsOfRoughness) {
    const std::vector<float> texels = environment_brdf_table(4, 16);
    ASSERT_EQ(texels.size(), 2U * 4 * 4);
    const EnvironmentBrdf brdf = environment_brdf(0.875, 0.375, 16);  // column 3, row 1
    EXPECT_FLOAT_EQ(texels[2 * (1 * 4 + 3)], static_cast<float>(brdf.a));
    EXPECT_FLOAT_EQ(texels[2 * (1 * 4 + 3) + 1], static_cast<float>(brdf.b));
}

}  // namespace
}  // namespace gobo
