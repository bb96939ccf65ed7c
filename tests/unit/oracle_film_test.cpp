// The oracle's thin film by itself: limits, and the numbers that KHR_materials_iridescence states.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "lab/oracle/reflectance_extensions.hpp"

namespace gobo::oracle {
namespace {

constexpr double kPi = std::numbers::pi;

struct Film {
    std::string name;
    double f0;
    double ior;
    double thickness;  ///< nanometres
    double cosine;
    glm::dvec3 expected;
};

glm::dvec3 reflectance(const Film& film) {
    const Reflectance surface{glm::dvec3(film.f0), glm::dvec3(film.f0), 1, 0};
    Roundings exact;
    for (const ReflectanceExtension& extension : reflectance_extensions())
        if (std::string(extension.feature) == "iridescence")
            return extension.at({1, film.ior, film.thickness}, surface, film.cosine, exact).value;
    return glm::dvec3(-1);
}

TEST(OracleFilm, HasItsLimits) {
    const double upper = 1.0 / 9;   // of an index of 2
    const double lower = 1.0 / 49;  // of 1.5 beneath 2
    const double incoherent = upper + (1 - upper) * (1 - upper) * lower / (1 - upper * lower);
    const Film rows[] = {
        {"over a mirror", 1, 1.7, 300, 0.6, glm::dvec3(1)},
        {"edge on over a mirror", 1, 1.7, 300, 0, glm::dvec3(1)},
        {"of air, head on", 0.04, 1, 300, 1, glm::dvec3(0.04)},
        {"of the base's own index", 0.04, 1.5, 300, 1, glm::dvec3(0.04)},
        {"so thick that all wavelengths mix", 0.04, 2, 1e6, 1, glm::dvec3(incoherent)},
    };
    for (const Film& row : rows)
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(reflectance(row)[i], row.expected[i], 1e-4) << row.name;
}

TEST(OracleFilm, MakesGlassReflectLessAtAQuarterOfAWave) {
    const double index = 1.38;  // magnesium fluoride on glass of 1.52, for 550 nm
    const double glass = 1.52;
    const double f0 = std::pow((glass - 1) / (glass + 1), 2);
    const double at_wave = std::pow((glass - index * index) / (glass + index * index), 2);
    const glm::dvec3 found = reflectance({"", f0, index, 550 / (4 * index), 1, {}});
    EXPECT_NEAR(found.g, at_wave, 1e-3);  // green is more than that one wavelength
    EXPECT_LT(std::max({found.r, found.g, found.b}), f0 / 2);
}

/// As the extension prints it, in metres; F0 without the 1e-4 that it adds.
glm::dvec3 as_printed(const Film& film) {
    const auto schlick = [](double r0, double c) { return r0 + (1 - r0) * std::pow(1 - c, 5); };
    const double root = std::sqrt(film.f0);
    const double base = (1 + root) / (1 - root);
    const double inside = std::sqrt(1 - (1 - film.cosine * film.cosine) / (film.ior * film.ior));
    const double r12 = schlick(std::pow((film.ior - 1) / (film.ior + 1), 2), film.cosine);
    const double r23 = schlick(std::pow((base - film.ior) / (base + film.ior), 2), inside);
    const double shift = kPi + (base < film.ior ? kPi : 0);
    const double path = 2 * film.ior * film.thickness * inside;
    const auto peak = [&](double value, double position, double variance, double m) {
        const double phase = 2 * kPi * m * path * 1e-9;
        return value * std::sqrt(2 * kPi * variance) * std::cos(position * phase + m * shift) *
               std::exp(-phase * phase * variance) / 1.0685e-7;
    };
    const double returned = (1 - r12) * (1 - r12) * r23 / (1 - r12 * r23);
    glm::dvec3 sum(r12 + returned);
    for (int m = 1; m <= 2; ++m) {
        const double x = peak(5.4856e-13, 1.6810e6, 4.3278e9, m) + peak(9.7470e-14, 2.2399e6, 4.5282e9, m);
        const double y = peak(4.4201e-13, 1.7953e6, 9.3046e9, m);
        const double z = peak(5.2481e-13, 2.2084e6, 6.6121e9, m);
        const glm::dvec3 rgb(3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                             -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                             0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
        sum += 2 * (returned - (1 - r12)) * std::pow(std::sqrt(r12 * r23), m) * rgb;
    }
    return glm::clamp(sum, 0.0, 1.0);
}

TEST(OracleFilm, HasTheNumbersOfTheExtension) {
    const Film rows[] = {{"as the extension's example, on plastic", 0.04, 1.3, 1200, 0.8, {}},
                         {"at its defaults, on gold", 0.7, 1.3, 400, 0.5, {}},
                         {"thin and dense, on glass", 0.04, 2.4, 150, 0.9, {}},
                         {"seen along the surface", 0.2, 1.5, 500, 0.1, {}}};
    for (const Film& row : rows)
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(reflectance(row)[i], as_printed(row)[i], 2e-6) << row.name;
}

}  // namespace
}  // namespace gobo::oracle
