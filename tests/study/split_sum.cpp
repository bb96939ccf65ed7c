// How far the split sum is from the integral that it stands for, on a fixed grid of roughness, angle and
// environment: a table. Nothing here is from shader_lib/.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gobo/environment_brdf.hpp"
#include "lab/oracle/microfacets.hpp"

namespace gobo {
namespace {

using Direction = glm::dvec3;
constexpr double kPi = std::numbers::pi;

/// Radiance by direction; the surface's normal is +z.
struct Environment {
    const char* name;
    std::function<double(const Direction&)> radiance;
};

/// A round light of mean radiance 1 over the sphere, as narrow as `sharpness` says.
double lobe(const Direction& d, const Direction& towards, double sharpness) {
    return 2 * sharpness * std::exp(sharpness * (glm::dot(d, towards) - 1)) / (1 - std::exp(-2 * sharpness));
}

const std::vector<Environment>& environments() {
    const Direction aside = glm::normalize(Direction(0.8, 0.3, 0.5));
    static const std::vector<Environment> kAll = {
        {"even", [](const Direction&) { return 1.0; }},
        {"sky and ground", [](const Direction& d) { return 1 + std::tanh(8 * d.z); }},
        {"side", [](const Direction& d) { return 1 + std::tanh(4 * d.x); }},
        {"lamp", [aside](const Direction& d) { return lobe(d, aside, 8); }},
        {"sun", [aside](const Direction& d) { return lobe(d, aside, 200); }}};
    return kAll;
}

/// Calls visit(light, weight) for the mirror directions of half vectors as frequent as the distribution has
/// them, on a grid of `grid` by `grid`.
template <class Visit>
void for_each_light(const Direction& viewer, double alpha, int grid, const Visit& visit) {
    const double square = alpha * alpha;
    for (int i = 0; i < grid; ++i) {
        const double left = (i + 0.5) / grid;  // close together where n.h nears 0
        const double u = 1 - left * left;
        const double nh = std::sqrt((1 - u) / (1 + (square - 1) * u));
        const double sine = std::sqrt(std::max(1 - nh * nh, 0.0));
        for (int j = 0; j < 2 * grid; ++j) {
            const double azimuth = kPi * (j + 0.5) / grid;
            const Direction half(sine * std::cos(azimuth), sine * std::sin(azimuth), nh);
            const double vh = glm::dot(viewer, half);
            const Direction light = 2 * vh * half - viewer;
            if (light.z > 0 && vh > 0) visit(light, half, 2 * left / (2.0 * grid * grid));
        }
    }
}

/// The integral of D V F n.l L over all lights, of a surface of that F0 and F90 1.
double integral(const Environment& environment, double nv, double roughness, double f0, int grid) {
    const Direction viewer(std::sqrt(1 - nv * nv), 0, nv);
    const double alpha = oracle::alpha_of_roughness(roughness);
    oracle::Roundings exact;
    double sum = 0;
    for_each_light(viewer, alpha, grid, [&](const Direction& light, const Direction& half, double weight) {
        const double vh = glm::dot(viewer, half);
        const double fresnel = f0 + (1 - f0) * std::pow(1 - vh, 5);
        const double visibility = oracle::visibility_term(oracle::MaskingShadowing::correlated, alpha,
                                                          light.z, nv, 4 * vh * vh, exact);
        sum += weight * 4 * visibility * light.z * vh / half.z * fresnel * environment.radiance(light);
    });
    return sum;
}

/// The environment as a map blurred for that roughness holds it by the mirrored direction: n = v = r.
double blurred(const Environment& environment, const Direction& mirrored, double roughness, int grid) {
    const Direction z = mirrored;
    const Direction x = glm::normalize(std::abs(z.x) < 0.9 ? glm::cross(Direction(1, 0, 0), z)
                                                           : glm::cross(Direction(0, 1, 0), z));
    const Direction y = glm::cross(z, x);
    double sum = 0;
    double weights = 0;
    for_each_light(Direction(0, 0, 1), oracle::alpha_of_roughness(roughness), grid,
                   [&](const Direction& light, const Direction& /*half*/, double weight) {
                       sum +=
                           weight * light.z * environment.radiance(light.x * x + light.y * y + light.z * z);
                       weights += weight * light.z;
                   });
    return sum / weights;
}

struct Figure {
    double largest = 0;
    double squares = 0;
    int count = 0;
    void add(double error) {
        largest = std::max(largest, std::abs(error));
        squares += error * error;
        ++count;
    }
    [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
};

constexpr std::array kRoughness = {0.1, 0.25, 0.5, 0.75, 1.0};
constexpr std::array kAngles = {0.0, 30.0, 60.0, 75.0, 85.0};
constexpr std::array kF0 = {0.04, 0.5, 1.0};
constexpr int kGrid = 128;

/// "environment,brdf,largest,rms,largest_of_integral,integral_known_to", in parts of the environment's mean
/// radiance.
std::string table() {
    const std::vector<std::pair<const char*, oracle::EnvironmentBrdf>> kinds = {
        {"table", oracle::EnvironmentBrdf::table},
        {"karis", oracle::EnvironmentBrdf::karis},
        {"lazarov", oracle::EnvironmentBrdf::lazarov},
        {"constant", oracle::EnvironmentBrdf::constant}};
    std::string text = "environment,environment_brdf,error_max,error_rms,integral_max,integral_known_to\n";
    for (const Environment& environment : environments()) {
        std::vector<Figure> errors(kinds.size());
        Figure step;
        double largest = 0;
        for (const double roughness : kRoughness)
            for (const double angle : kAngles) {
                const double nv = std::cos(angle * kPi / 180);
                const Direction mirrored(-std::sqrt(1 - nv * nv), 0, nv);
                const double seen = blurred(environment, mirrored, roughness, kGrid);
                const EnvironmentBrdf exact = environment_brdf(nv, roughness, kGrid);
                for (const double f0 : kF0) {
                    const double fine = integral(environment, nv, roughness, f0, kGrid);
                    step.add(fine - integral(environment, nv, roughness, f0, kGrid / 2));
                    largest = std::max(largest, fine);
                    for (std::size_t k = 0; k < kinds.size(); ++k) {
                        const glm::dvec2 brdf =
                            oracle::environment_brdf(kinds[k].second, {exact.a, exact.b}, nv, roughness);
                        errors[k].add(seen * (brdf.x * f0 + brdf.y) - fine);
                    }
                }
            }
        for (std::size_t k = 0; k < kinds.size(); ++k)
            text += fmt::format("{},{},{:.2g},{:.2g},{:.2g},{:.1g}\n", environment.name, kinds[k].first,
                                errors[k].largest, errors[k].rms(), largest, step.largest);
    }
    return text;
}

}  // namespace
}  // namespace gobo

int main() {
    fmt::print("{}", gobo::table());
}
