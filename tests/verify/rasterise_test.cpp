// The software rasteriser against what can be said of triangles without one.
#include "lab/raster/rasterise.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace gobo::raster {
namespace {

constexpr int kSide = 8;

/// A point of the window, in pixels, at eye distance `w`.
glm::dvec4 at(double x, double y, double w = 1, double depth = 0) {
    return glm::dvec4(2 * x / kSide - 1, 2 * y / kSide - 1, depth, 1) * w;
}

TEST(Rasterise, CoversEachPixelOfTwoTrianglesOnceAlsoOnTheirCommonEdge) {
    // The diagonal passes through the centres of eight pixels.
    const std::vector<glm::dvec4> corners = {at(0, 0), at(8, 0), at(8, 8), at(0, 8)};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    std::vector<int> covered(kSide * kSide, 0);
    int near_edge = 0;
    for (const Fragment& fragment : rasterise(corners, indices, kSide, kSide)) {
        if (fragment.is_covered) ++covered[static_cast<std::size_t>(fragment.y * kSide + fragment.x)];
        if (fragment.is_near_edge) ++near_edge;
        EXPECT_TRUE(fragment.is_front_facing);
    }
    EXPECT_EQ(covered, std::vector<int>(kSide * kSide, 1));
    EXPECT_EQ(near_edge, 2 * kSide) << "those on the diagonal, of either triangle";
}

TEST(Rasterise, LeavesOutTheBottomAndRightEdge) {
    const std::vector<glm::dvec4> corners = {at(1.5, 1.5), at(3.5, 1.5), at(3.5, 3.5), at(1.5, 3.5)};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    std::vector<std::pair<int, int>> covered;
    for (const Fragment& fragment : rasterise(corners, indices, kSide, kSide))
        if (fragment.is_covered) covered.emplace_back(fragment.y, fragment.x);
    std::sort(covered.begin(), covered.end());
    EXPECT_EQ(covered, (std::vector<std::pair<int, int>>{{2, 1}, {2, 2}, {3, 1}, {3, 2}}));
}

TEST(Rasterise, InterpolatesInPerspective) {
    // Halfway across the window from w = 1 to w = 3, 1/w is 2/3: a quarter of the way along the edge.
    const Interpolator interpolator({at(0, 0, 1), at(8, 0, 3), at(0, 8, 1)}, kSide, kSide);
    const Weights weights = interpolator.at(4, 0);
    EXPECT_NEAR(weights.inverse_w, 2.0 / 3, 1e-15);
    EXPECT_NEAR(weights.perspective[0], 0.75, 1e-15);
    EXPECT_NEAR(weights.perspective[1], 0.25, 1e-15);
    EXPECT_NEAR(weights.linear[0], 0.5, 1e-15);
    EXPECT_NEAR(weights.linear[1], 0.5, 1e-15);
    EXPECT_NEAR(weights.linear[2], 0, 1e-15);
}

TEST(Rasterise, ClipsAtTheNearPlane) {
    // A floor from 1 before the eye to 1 behind it, seen with the near plane at 0.1: it ends in the window.
    const auto floor_point = [](double x, double distance) {
        return glm::dvec4(x, -0.05, (distance * 10.1 - 2) / 9.9, distance);
    };
    const std::vector<glm::dvec4> corners = {floor_point(-20, -1), floor_point(20, -1), floor_point(0, 1)};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    int covered = 0;
    for (const Fragment& fragment : rasterise(corners, indices, kSide, kSide)) {
        if (!fragment.is_covered) continue;
        ++covered;
        EXPECT_GE(fragment.weights.inverse_w, 1) << "nothing beyond the far corner";
        EXPECT_LE(fragment.weights.inverse_w, 10) << "nothing before the near plane";
        EXPECT_LT(fragment.y, kSide / 2) << "a floor stays below the horizon";
    }
    EXPECT_GT(covered, 0);
}

TEST(Rasterise, LeavesOutWhatHasNoArea) {
    const std::vector<glm::dvec4> corners = {at(0, 0), at(4, 4), at(8, 8)};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    EXPECT_TRUE(rasterise(corners, indices, kSide, kSide).empty());
}

TEST(Rasterise, CutsOffWhatRunsToInfinity) {
    // At one depth nothing is clipped before w = 0, towards which the sides run out of all numbers.
    const auto corner = [](double x, double y, double w) { return glm::dvec4(x, y, 0.25 * w, w); };
    const std::array<glm::dvec4, 3> corners = {corner(-0.55, -0.95, 1), corner(0.35, -0.95, 1),
                                               corner(0.05, 3, -1)};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    std::vector<bool> covered(kSide * kSide);
    for (const Fragment& fragment : rasterise(corners, indices, kSide, kSide))
        covered[static_cast<std::size_t>(fragment.y * kSide + fragment.x)] = fragment.is_covered;
    const Interpolator interpolator(corners, kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Weights weights = interpolator.at(x + 0.5, y + 0.5);
            const bool is_inside = weights.inverse_w > 0 &&
                                   std::ranges::all_of(weights.perspective, [](double w) { return w >= 0; });
            EXPECT_EQ(covered[static_cast<std::size_t>(y * kSide + x)], is_inside) << x << " " << y;
        }
    EXPECT_GT(std::ranges::count(covered, true), kSide);
}

TEST(Rasterise, LeavesOutWhatIsNowhere) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double place : {nan, infinity}) {
        const std::vector<glm::dvec4> corners = {at(0, 0), at(8, 0), {place, 0, 0, 1}};
        const std::vector<std::uint32_t> indices = {0, 1, 2};
        EXPECT_TRUE(rasterise(corners, indices, kSide, kSide).empty()) << place;
    }
}

}  // namespace
}  // namespace gobo::raster
