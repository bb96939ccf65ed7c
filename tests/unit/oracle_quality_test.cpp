// The oracle's stand-ins for exact formulas against closed forms, limits and the errors their sources state.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lab/oracle/oracle.hpp"

namespace gobo::oracle {
namespace {

constexpr double kRounding = 1e-13;

TEST(OraclePower, HasTheClosedForms) {
    EXPECT_NEAR(lobe(Power::exact, 0.5, 3), 0.125, kRounding);
    EXPECT_NEAR(lobe(Power::squaring, 0.5, 3.4), 0.125, kRounding) << "the nearest whole exponent";
    EXPECT_NEAR(lobe(Power::squaring, 0.5, 2.5), 0.25, kRounding) << "the even one of two as near";
    EXPECT_NEAR(lobe(Power::gaussian, 0.5, 2), std::exp(-1), kRounding);
    EXPECT_NEAR(lobe(Power::gaussian_fitted, 0.5, 2), std::exp(-1.332), kRounding);
    EXPECT_NEAR(lobe(Power::lyon, 0.5, 4), 0.0625, kRounding) << "(1 - u)^4, which is exact at 4";
    EXPECT_EQ(lobe(Power::lyon, 0.5, 9), 0) << "beyond u = 4 / m";
    EXPECT_NEAR(lobe(Power::schlick, 0.25, 1), 0.75, kRounding) << "exact at exponent 1";
    EXPECT_NEAR(lobe(Power::schlick, 0.5, 3), 0.25, kRounding);
    const double z = 0.5 / 1.5;
    EXPECT_NEAR(lobe(Power::near_exact, 0.5, 1), std::exp(-2 * (z + z * z * z / 3)), kRounding);
}

struct PowerRow {
    std::string name;
    Power power;
    double at_zero_exponent;      ///< at a right angle
    double beyond_right_angle;    ///< at exponent 2 and a one minus cosine of 1.5
    double error_times_exponent;  ///< at exponent 100: the largest difference from the exact power, times 100
};

/// What the pieces' comments state of them.
TEST(OraclePower, IsAsFarOffAsStated) {
    const std::vector<PowerRow> rows = {
        {"near_exact", Power::near_exact, 1, 0, 2.7e-7},
        {"squaring", Power::squaring, 1, 0, 1e-9},
        {"gaussian_fitted", Power::gaussian_fitted, std::exp(-0.664), std::exp(-2.664 * 1.5), 0.127},
        {"gaussian", Power::gaussian, 1, std::exp(-3), 0.272},
        {"lyon", Power::lyon, 1, std::pow(0.25, 4), 7.2},
        {"schlick", Power::schlick, 1, 0, 20.2},
    };
    for (const PowerRow& row : rows) {
        SCOPED_TRACE(row.name);
        EXPECT_NEAR(lobe(row.power, 1, 0), row.at_zero_exponent, kRounding);
        EXPECT_NEAR(lobe(row.power, 1.5, 2), row.beyond_right_angle, kRounding);
        double largest = 0;
        for (double one_minus_cosine = 0; one_minus_cosine < 0.2; one_minus_cosine += 1e-5) {
            const double exact = lobe(Power::exact, one_minus_cosine, 100);
            largest = std::max(largest, std::abs(lobe(row.power, one_minus_cosine, 100) - exact));
        }
        EXPECT_LE(largest * 100, row.error_times_exponent);
        EXPECT_GE(largest * 100, row.power == Power::squaring ? 0 : 0.95 * row.error_times_exponent);
    }
}

/// A grey surface at (1, 2, -5), lit from the front right, seen at an angle.
Scene scene() {
    Scene scene;
    scene.material = {{}, {}, glm::dvec3(0.5), glm::dvec3(1), 10, 1};
    scene.directional = {{{0.6, 0, 0.8}, glm::dvec3(1)}};
    return scene;
}

const glm::dvec3 kPosition = {1, 2, -5};

double red(const Model& model, const SurfacePoint& point) {
    Decisions decisions;
    return lit_radiance(model, scene(), point, decisions).value.r;
}

TEST(OracleQuality, AnInfiniteViewerIsALocalOneStraightAhead) {
    const Model infinite{.directional = 1, .specular = Specular::blinn, .viewer = Viewer::infinite};
    const Model local{.directional = 1, .specular = Specular::blinn};
    EXPECT_NE(red(infinite, {kPosition, {0, 0, 1}}), red(local, {kPosition, {0, 0, 1}}));
    EXPECT_NEAR(red(infinite, {kPosition, {0, 0, 1}}), red(local, {{0, 0, -5}, {0, 0, 1}}), kRounding);
}

TEST(OracleQuality, ANormalAsItIsCountsByItsLength) {
    const Model as_it_is{.directional = 1, .normal = Normal::interpolated};
    EXPECT_NEAR(red(as_it_is, {kPosition, {0, 0, 0.5}}), 0.5 * 0.8 / 2, kRounding) << "diffuse by half";
    Model blinn{.directional = 1, .specular = Specular::blinn, .normal = Normal::interpolated};
    const double cosine =
        glm::dot(glm::dvec3(0, 0, 0.9), glm::normalize(glm::dvec3(0.6, 0, 0.8) + glm::normalize(-kPosition)));
    EXPECT_NEAR(red(blinn, {kPosition, {0, 0, 0.9}}), 0.9 * 0.8 / 2 + std::pow(cosine, 10), kRounding);
    blinn.normal = Normal::renormalised;
    EXPECT_NEAR(red(blinn, {kPosition, {0, 0, 0.9}}), red(blinn, {kPosition, {0, 0, 1}}), kRounding);
}

TEST(OracleQuality, HybridShadingAtAVertexIsFragmentShading) {
    const glm::dvec3 half = glm::normalize(glm::dvec3(0.6, 0, 0.8) + glm::normalize(-kPosition));
    for (const Specular specular : {Specular::none, Specular::phong, Specular::blinn}) {
        const Model fragment{.directional = 1, .specular = specular};
        const Model hybrid{.directional = 1, .specular = specular, .shading = Shading::hybrid};
        SurfacePoint given{kPosition, {0, 0, 1}};
        given.halfways = {half};
        EXPECT_NEAR(red(hybrid, given), red(fragment, given), kRounding);
    }
}

}  // namespace
}  // namespace gobo::oracle
