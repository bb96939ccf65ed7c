#include "lab/probe/harmonics.hpp"

#include <fmt/format.h>

namespace gobo::probe {
namespace {

constexpr std::array<std::string_view, 9> kNames = {"L00",  "L1m1", "L10", "L11", "L2m2",
                                                    "L2m1", "L20",  "L21", "L22"};

/// The nine real spherical harmonics (equation 3).
std::array<double, 9> basis(const glm::dvec3& w) {
    return {0.282095,
            0.488603 * w.y,
            0.488603 * w.z,
            0.488603 * w.x,
            1.092548 * w.x * w.y,
            1.092548 * w.y * w.z,
            0.315392 * (3 * w.z * w.z - 1),
            1.092548 * w.x * w.z,
            0.546274 * (w.x * w.x - w.y * w.y)};
}

}  // namespace

Harmonics project(const Environment& environment) {
    Harmonics harmonics{};
    for (int row = 0; row < environment.height; ++row) {
        const double angle = solid_angle(environment, row);
        for (int column = 0; column < environment.width; ++column) {
            const std::array<double, 9> shares = basis(direction_of(environment, column, row));
            for (std::size_t i = 0; i < 9; ++i)
                harmonics[i] += (angle * shares[i]) * environment.at(column, row);
        }
    }
    return harmonics;
}

glm::dvec3 irradiance(const Harmonics& harmonics, const glm::dvec3& normal) {
    // A clamped cosine's own coefficients: pi, 2 pi / 3 and pi / 4 by order (equation 8).
    constexpr std::array<double, 9> cosine = {3.141593, 2.094395, 2.094395, 2.094395, 0.785398,
                                              0.785398, 0.785398, 0.785398, 0.785398};
    const std::array<double, 9> shares = basis(normal);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 9; ++i) sum += (cosine[i] * shares[i]) * harmonics[i];
    return sum;
}

std::string to_csv(const Harmonics& harmonics, std::string_view name) {
    std::string text = "probe,coefficient,red,green,blue\n";
    for (std::size_t i = 0; i < 9; ++i)
        text += fmt::format("{},{},{:.6g},{:.6g},{:.6g}\n", name, kNames[i], harmonics[i].r, harmonics[i].g,
                            harmonics[i].b);
    return text;
}

}  // namespace gobo::probe
