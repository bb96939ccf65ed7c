// Light probes against closed forms: environments whose convolutions and harmonics are known.
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "lab/oracle/environment.hpp"
#include "lab/probe/environment.hpp"
#include "lab/render/image.hpp"

namespace gobo::probe {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kLight = glm::normalize(glm::dvec3(0.3, 0.7, -0.5));

Environment environment(int height, const std::function<double(const glm::dvec3&)>& radiance) {
    Environment result{2 * height, height, {}};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < 2 * height; ++column)
            result.texels.emplace_back(radiance(direction_of(result, column, row)));
    return result;
}

Environment one_texel(int height, int column, int row, double radiance) {
    Environment result = environment(height, [](const glm::dvec3&) { return 0.0; });
    result.texels[static_cast<std::size_t>(row * 2 * height + column)] = glm::dvec3(radiance);
    return result;
}

/// Directions all around, poles and seam among them.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> result = {{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0}, kLight, -kLight};
    for (int i = 0; i < 40; ++i) {
        const double y = -0.975 + 0.05 * i;
        const double around = 2.4 * i;
        const double level = std::sqrt(1 - y * y);
        result.emplace_back(level * std::cos(around), y, level * std::sin(around));
    }
    return result;
}

double angle_to_light(const glm::dvec3& direction) {
    return std::acos(std::clamp(glm::dot(direction, kLight), -1.0, 1.0));
}

struct ClosedForm {
    const char* name;
    Environment environment;
    double exponent;
    std::function<double(const glm::dvec3&)> mean;
    double tolerance;  ///< absolute, of values about 1
};

const Environment kUpperHalf = environment(128, [](const glm::dvec3& w) { return w.y > 0 ? 1.0 : 0.0; });
const Environment kLobe =
    environment(128, [](const glm::dvec3& w) { return std::max(glm::dot(w, kLight), 0.0); });
constexpr int kColumn = 100;
constexpr int kRow = 31;
const Environment kTexel = one_texel(128, kColumn, kRow, 1e4);

double texel_energy() {
    return 1e4 * solid_angle(kTexel, kRow);
}

std::vector<ClosedForm> closed_forms() {
    std::vector<ClosedForm> rows;
    // The weights' sum divides, so what is the same everywhere stays so but for roundings.
    for (const double exponent : {1.0, 2.0, 48.0, 1000.0})
        rows.push_back({"constant", environment(64, [](const glm::dvec3&) { return 0.75; }), exponent,
                        [](const glm::dvec3&) { return 0.75; }, 1e-12});
    // A lobe that falls between texels takes the nearest, half a texel away at most.
    rows.push_back({"between_texels",
                    environment(64, [](const glm::dvec3& w) { return 2 + w.x + w.y / 2 + w.z / 4; }), 1e6,
                    [](const glm::dvec3& n) { return 2 + n.x + n.y / 2 + n.z / 4; }, 0.04});
    // The share of the sky: the midpoint rule over 128 rows is off by pi^2 / (24 * 128^2) of the integral's
    // curvature, at most 1e-4.
    rows.push_back({"half", kUpperHalf, 1, [](const glm::dvec3& n) { return (1 + n.y) / 2; }, 1e-4});
    // Two clamped cosines at an angle g: 2 / 3 (sin g + (pi - g) cos g), over pi.
    rows.push_back({"lobe", kLobe, 1,
                    [](const glm::dvec3& n) {
                        const double angle = angle_to_light(n);
                        return 2 / (3 * kPi) * (std::sin(angle) + (kPi - angle) * std::cos(angle));
                    },
                    1e-4});
    // A light in one direction: its irradiance by its own solid angle; a texel of a fortieth of a radian
    // spreads the cosine by 1e-4 of it, and near the horizon by the texel's half.
    rows.push_back({"texel", kTexel, 1,
                    [](const glm::dvec3& n) {
                        const double cosine = glm::dot(n, direction_of(kTexel, kColumn, kRow));
                        return texel_energy() * std::max(cosine, 0.0) / kPi;
                    },
                    2e-4 * texel_energy()});
    for (const double exponent : {8.0, 48.0})
        rows.push_back({"texel_shiny", kTexel, exponent,
                        [exponent](const glm::dvec3& r) {
                            const double cosine =
                                std::max(glm::dot(r, direction_of(kTexel, kColumn, kRow)), 0.0);
                            return texel_energy() * (exponent + 1) / (2 * kPi) * std::pow(cosine, exponent);
                        },
                        // The peak is (m + 1) / 2 pi; the midpoint rule over a texel is off by m / 12 of the
                        // square of its size.
                        2e-3 * texel_energy() * (exponent + 1) / (2 * kPi)});
    return rows;
}

class Convolution : public testing::TestWithParam<ClosedForm> {};

TEST_P(Convolution, IsTheClosedForm) {
    const ClosedForm& form = GetParam();
    const Lobe lobe(form.environment, form.exponent);
    for (const glm::dvec3& direction : directions())
        EXPECT_NEAR(lobe.around(direction).r, form.mean(direction), form.tolerance)
            << direction.x << " " << direction.y << " " << direction.z;
}

INSTANTIATE_TEST_SUITE_P(Probe, Convolution, testing::ValuesIn(closed_forms()), [](const auto& form) {
    return std::string(form.param.name) + "_" + std::to_string(static_cast<int>(form.param.exponent));
});

TEST(Probe, ReducesWhatALobeCannotTellApart) {
    const Environment large = environment(512, [](const glm::dvec3& w) { return 1 + w.x * w.y; });
    EXPECT_EQ(Lobe(large, 1).rows(), 128);
    EXPECT_EQ(Lobe(large, 1000).rows(), 512);
    const Lobe reduced(large, 1);
    const Lobe small(environment(128, [](const glm::dvec3& w) { return 1 + w.x * w.y; }), 1);
    for (const glm::dvec3& direction : directions())
        EXPECT_NEAR(reduced.around(direction).g, small.around(direction).g, 1e-4);
}

/// The coefficients of an environment in closed form, in the order of `Harmonics`.
struct Coefficients {
    const char* name;
    Environment environment;
    std::array<double, 9> expected;
    double tolerance;
};

class Projection : public testing::TestWithParam<Coefficients> {};

TEST_P(Projection, IsTheClosedForm) {
    const Harmonics found = project(GetParam().environment);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(found[i].b, GetParam().expected[i], GetParam().tolerance) << i;
}

/// Y of the direction, times `by_order` of its order.
std::array<double, 9> harmonics_at(const glm::dvec3& w, const std::array<double, 3>& by_order) {
    const std::array<double, 9> y = {1,
                                     std::sqrt(3.0) * w.y,
                                     std::sqrt(3.0) * w.z,
                                     std::sqrt(3.0) * w.x,
                                     std::sqrt(15.0) * w.x * w.y,
                                     std::sqrt(15.0) * w.y * w.z,
                                     std::sqrt(5.0) / 2 * (3 * w.z * w.z - 1),
                                     std::sqrt(15.0) * w.x * w.z,
                                     std::sqrt(15.0) / 2 * (w.x * w.x - w.y * w.y)};
    std::array<double, 9> result{};
    for (std::size_t i = 0; i < 9; ++i)
        result[i] = by_order[i == 0 ? 0 : i < 4 ? 1 : 2] * y[i] / std::sqrt(4 * kPi);
    return result;
}

INSTANTIATE_TEST_SUITE_P(
    Probe, Projection,
    testing::Values(
        // The published constants have six digits: 2e-6 of 4 pi. The midpoint rule over 128 rows adds 1e-4.
        Coefficients{"constant",
                     environment(128, [](const glm::dvec3&) { return 2.0; }),
                     {2 * std::sqrt(4 * kPi), 0, 0, 0, 0, 0, 0, 0, 0},
                     1e-3},
        Coefficients{"half", kUpperHalf, {std::sqrt(kPi), std::sqrt(3 * kPi) / 2, 0, 0, 0, 0, 0, 0, 0}, 1e-3},
        // A clamped cosine about a direction: pi, 2 pi / 3, pi / 4 times the harmonics there.
        Coefficients{"lobe", kLobe, harmonics_at(kLight, {kPi, 2 * kPi / 3, kPi / 4}), 1e-3},
        Coefficients{"texel", kTexel,
                     harmonics_at(direction_of(kTexel, kColumn, kRow),
                                  {texel_energy(), texel_energy(), texel_energy()}),
                     1e-5 * texel_energy()}),
    [](const auto& row) { return row.param.name; });

TEST(Probe, FacesAreThoseOfOpenGL) {
    const auto centre = [](int face) { return cube_direction(face, 1, 0, 0); };
    EXPECT_EQ(centre(0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(centre(3), glm::dvec3(0, -1, 0));
    EXPECT_EQ(centre(4), glm::dvec3(0, 0, 1));
    // Table 8.19: on +x, s grows with -z and t with -y; on +y, with x and z.
    EXPECT_LT(cube_direction(0, 4, 3, 0).z, 0);
    EXPECT_GT(cube_direction(0, 4, 3, 0).y, 0);
    EXPECT_GT(cube_direction(2, 4, 3, 3).x, 0);
    EXPECT_GT(cube_direction(2, 4, 3, 3).z, 0);
}

TEST(Probe, TheMapLooksAlongZInItsMiddleAndHasXOnItsLeft) {
    const Environment map{4, 2, std::vector<glm::dvec3>(8)};
    EXPECT_GT(direction_of(map, 1, 0).z, 0);
    EXPECT_GT(direction_of(map, 1, 0).x, 0);
    EXPECT_GT(direction_of(map, 1, 0).y, 0);
    EXPECT_LT(direction_of(map, 3, 1).x, 0);
    EXPECT_LT(direction_of(map, 3, 1).y, 0);
}

/// The shipped environments: what no convolution changes, and how near nine coefficients come.
TEST(Probe, ShippedEnvironmentsKeepTheirEnergy) {
    for (const std::string name : {"studio", "night"}) {
        SCOPED_TRACE(name);
        const std::string path = std::string(GOBO_SOURCE_DIR) + "/data/environments/" + name + ".exr";
        const Environment map = environment_of(read_image(DiskFileSystem(), path).value(), path).value();
        glm::dvec3 mean(0);
        for (int row = 0; row < map.height; ++row)
            for (int column = 0; column < map.width; ++column)
                mean += solid_angle(map, row) / (4 * kPi) * map.at(column, row);
        const Lobe diffuse(map, 1);
        const Harmonics harmonics = project(map);
        glm::dvec3 scattered(0);
        double squares = 0;
        constexpr int kSide = 8;
        const Image cube = make_cube_map(kSide, 2, [&](const glm::dvec3& n) { return diffuse.around(n); });
        double area = 0;
        for (int row = 0; row < 6 * kSide; ++row)
            for (int column = 0; column < kSide; ++column) {
                const glm::dvec3 n = cube_direction(row / kSide, kSide, column, row % kSide);
                const double s = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
                const double weight = s * s * s;  // a texel's solid angle, up to a factor
                const double green = cube.at(column, row, 1);
                scattered += weight * glm::dvec3(cube.at(column, row, 0), green, cube.at(column, row, 2));
                squares +=
                    weight *
                    std::pow(oracle::irradiance(oracle::Harmonics::second, harmonics, n).g / kPi - green, 2);
                area += weight;
            }
        // 384 directions stand for all: 1 %. The nine coefficients come within 8 % of the mean in a
        // studio, whose softboxes are small.
        EXPECT_NEAR(scattered.g / area, mean.g, 0.01 * mean.g);
        EXPECT_LT(std::sqrt(squares / area), 0.1 * mean.g);
    }
}

TEST(Probe, IsTheSameForAnyNumberOfThreads) {
    const Lobe lobe(kLobe, 20);
    const auto around = [&](const glm::dvec3& direction) { return lobe.around(direction); };
    EXPECT_EQ(make_cube_map(8, 1, around), make_cube_map(8, 3, around));
}

TEST(Probe, TakesNegativeRadiancesAsNone) {
    Image image(8, 4, 3);
    image.at(2, 1, 0) = -0.25F;
    image.at(3, 1, 2) = -0.5F;
    const auto environment = environment_of(image, "map.exr");
    ASSERT_TRUE(environment);
    EXPECT_EQ(environment->at(2, 1), glm::dvec3(0));
    EXPECT_EQ(environment->negatives, 2);
    EXPECT_EQ(environment->most_negative, -0.5);
}

struct BadMap {
    const char* name;
    Image image;
    const char* text;
};

Image filled(int width, int height, int channels, float value) {
    Image image(width, height, channels);
    for (float& number : image.values) number = value;
    return image;
}

Image with_texel(float value) {
    Image image = filled(8, 4, 3, 1);
    image.at(5, 2, 1) = value;
    return image;
}

class Refusal : public testing::TestWithParam<BadMap> {};

TEST_P(Refusal, TellsWhatIsWrong) {
    const auto environment = environment_of(GetParam().image, "map.exr");
    ASSERT_FALSE(environment);
    EXPECT_EQ(to_text(environment.error().front(), false), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Probe, Refusal,
    testing::Values(
        BadMap{"square", filled(8, 8, 3, 1),
               "map.exr: error: a picture of 8 x 8 texels is not a latitude-longitude map\n"
               "  help: it must be twice as wide as high, and at least 4 x 2: all around, and from zenith "
               "to nadir\n"},
        BadMap{"too_small", filled(2, 1, 3, 1),
               "map.exr: error: a picture of 2 x 1 texels is not a latitude-longitude map\n"
               "  help: it must be twice as wide as high, and at least 4 x 2: all around, and from zenith "
               "to nadir\n"},
        BadMap{"grey", filled(8, 4, 1, 1),
               "map.exr: error: the picture has no colours\n  help: give one with the channels R, G and B\n"},
        BadMap{"not_a_number", with_texel(std::numeric_limits<float>::quiet_NaN()),
               "map.exr: error: the texel in column 5, row 2 (from the upper left, counted from 0) has the "
               "radiance nan "
               "in channel G\n  help: radiance is finite: fix the map, or clamp it where "
               "it was "
               "exported\n"},
        BadMap{"infinite", with_texel(std::numeric_limits<float>::infinity()),
               "map.exr: error: the texel in column 5, row 2 (from the upper left, counted from 0) has the "
               "radiance inf "
               "in channel G\n  help: radiance is finite: fix the map, or clamp it where "
               "it was "
               "exported\n"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::probe
