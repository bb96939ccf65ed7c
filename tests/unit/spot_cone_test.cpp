// One minus the cosine of half angles against that of known ones.
#include <cmath>

#include <gobo/spot_cone.hpp>
#include <gtest/gtest.h>

namespace {

struct Angle {
    const char* name;
    double degrees;
    double one_minus_cosine;
};

constexpr Angle angles[] = {{"nothing", 0, 0},      {"a third", 60, 0.5},
                            {"half space", 90, 1},  {"beyond the half space", 120, 1.5},
                            {"everything", 180, 2}, {"a laser", 0.005729577951308232, 5e-9}};

/// 2^-23: the float that is returned is rounded once, and the angle before it.
constexpr double rounding = 0x1p-23;

TEST(SpotCone, HasOneMinusTheCosineOfAnAngle) {
    for (const Angle& row : angles) {
        EXPECT_NEAR(gobo::one_minus_cosine_of_degrees(row.degrees), row.one_minus_cosine,
                    rounding * row.one_minus_cosine)
            << row.name;
        const double radians = row.degrees * std::acos(-1.0) / 180;
        EXPECT_NEAR(gobo::one_minus_cosine_of_radians(radians), row.one_minus_cosine,
                    rounding * row.one_minus_cosine)
            << row.name;
        EXPECT_NEAR(gobo::one_minus_cosine(1 - row.one_minus_cosine), row.one_minus_cosine,
                    rounding * row.one_minus_cosine)
            << row.name << ", by a cosine in double precision";
    }
}

}  // namespace
