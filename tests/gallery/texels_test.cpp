// Textures answer from their texels as OpenGL's do: exactly at a texel's centre, evenly between, over
// borders.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lab/evaluate/images.hpp"
#include "lab/probe/environment.hpp"

namespace gobo::evaluate {
namespace {

constexpr int kSide = 8;

ImageRequest at(double x, double y, double z = 0) {
    ImageRequest request;
    request.coordinates = {x, y, z, 0};
    return request;
}

/// Each texel holds its own number.
CubeTexels numbered_cube() {
    CubeTexels texels{kSide, {}};
    for (int i = 0; i < 6 * kSide * kSide; ++i) {
        const auto number = static_cast<float>(i);
        texels.colors.push_back({number, number + 1, number + 2, number + 3});
    }
    return texels;
}

/// A radiance that changes evenly over directions.
glm::dvec3 even(const glm::dvec3& direction) {
    return glm::dvec3(2) + direction;
}

TEST(CubeTexels, AnswerTheTexelItselfAtItsCentre) {
    const CubeTexels texels = numbered_cube();
    for (int i = 0; i < 6 * kSide * kSide; ++i) {
        const glm::dvec3 r = probe::cube_direction(i / (kSide * kSide), kSide, i % kSide, i / kSide % kSide);
        const auto color = answer(texels, at(3 * r.x, 3 * r.y, 3 * r.z));
        EXPECT_NEAR(color[0], i, 1e-9) << "face " << i / (kSide * kSide);
        EXPECT_NEAR(color[2], i + 2, 1e-9);
    }
}

TEST(CubeTexels, LeaveNoSeamBetweenFaces) {
    const auto faces = probe::make_cube_map(kSide, 1, even);
    CubeTexels texels{kSide, {}};
    for (int y = 0; y < faces.height; ++y)
        for (int x = 0; x < faces.width; ++x)
            texels.colors.push_back({faces.at(x, y, 0), faces.at(x, y, 1), faces.at(x, y, 2), 1});
    double furthest = 0;
    for (int i = 0; i < 2000; ++i) {
        const double turn = 0.0031 * i;  // around, at several heights: over every border
        const glm::dvec3 r =
            glm::normalize(glm::dvec3(std::cos(7 * turn), std::sin(5 * turn), std::sin(3 * turn)));
        const auto color = answer(texels, at(r.x, r.y, r.z));
        for (int channel = 0; channel < 3; ++channel)
            furthest =
                std::max(furthest, std::abs(color[static_cast<std::size_t>(channel)] - even(r)[channel]));
    }
    // A direction bends by (1/8)^2 / 2 over a texel; without the neighbour's texels half of one, 0.12, is
    // missing.
    EXPECT_LT(furthest, 0.02);
    EXPECT_GT(furthest, 1e-4) << "filtered between texels";
}

TEST(ColorTexels, RepeatAndBlendEvenly) {
    const ColorTexels texels{2, 1, {{0, 0, 0, 1}, {4, 8, 12, 0}}};
    struct Row {
        const char* name;
        double s;
        double red;
    };
    for (const Row& row :
         {Row{"a centre", 0.25, 0}, Row{"the other", 0.75, 4}, Row{"between", 0.5, 2},
          Row{"over the border", 1, 2}, Row{"a turn later", 3.75, 4}, Row{"before", -0.25, 4}}) {
        EXPECT_NEAR(answer(texels, at(row.s, 0.3))[0], row.red, 1e-12) << row.name;
        EXPECT_NEAR(answer(texels, at(row.s, 7.5))[2], 3 * row.red, 1e-12) << row.name;
    }
    ImageRequest size = at(0, 0);
    size.what = ImageRequest::What::size;
    EXPECT_EQ(answer(texels, size)[0], 2);
}

}  // namespace
}  // namespace gobo::evaluate
