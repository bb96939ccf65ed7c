// Each sharp highlight, at a shininess of 1e4 to 1e6, of surfaces, lights and viewers in any direction,
// against the equations in extended precision: no further off than what a float's rounding of the directions
// costs.
#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "lit_under_test.hpp"

namespace gobo {
namespace {

using Real = long double;
using Vector = glm::vec<3, Real>;

/// One point, as floats hold it.
struct Highlight {
    glm::vec3 normal;  ///< of any length below 1, as interpolation leaves it
    glm::vec3 position;
    glm::vec3 to_light;
};

/// Surfaces whose normal is within a few widths of the half vector, up to 75 degrees from light and viewer.
class Highlights {
  public:
    Highlight make(Real shininess) {
        const Vector normal = direction();
        const Vector halfway = turned(normal, unit() * 2.5L / std::sqrt(shininess));
        const Vector to_viewer = turned(halfway, unit() * 1.3L);
        const Vector to_light = 2 * glm::dot(halfway, to_viewer) * halfway - to_viewer;
        return {glm::vec3(normal * (0.3L + 0.7L * unit())),
                glm::vec3(-to_viewer * std::pow(10.0L, 3 * unit() - 1)), glm::vec3(to_light)};
    }

  private:
    Real unit() { return std::uniform_real_distribution<Real>(0, 1)(engine_); }
    Vector direction() {
        std::normal_distribution<Real> normal;
        return glm::normalize(Vector(normal(engine_), normal(engine_), normal(engine_)));
    }
    Vector turned(const Vector& from, Real angle) {
        const Vector aside = glm::normalize(glm::cross(from, direction()));
        return std::cos(angle) * from + std::sin(angle) * aside;
    }
    std::mt19937_64 engine_{1};
};

/// The factor of the highlight, and what it may be off by: 2 sqrt(m) 2^-24 / |s + v| and half a rounding of
/// the result. Phong's m counts four times, since its angle is twice as wide; and half as much again, since
/// the reflection doubles the normal's own rounding, which Blinn's model takes once.
struct Exact {
    Real factor;
    Real limit;
};

Exact exact_of(const Highlight& point, Real shininess, bool is_phong) {
    const Vector normal = glm::normalize(Vector(point.normal));
    const Vector to_viewer = glm::normalize(-Vector(point.position));
    const Vector to_light(point.to_light);
    const Vector sum = to_light + to_viewer;
    const Vector a = is_phong ? 2 * glm::dot(normal, to_light) * normal - to_light : normal;
    const Vector b = is_phong ? to_viewer : glm::normalize(sum);
    const Real one_minus_cosine =
        glm::dot(a - b, a - b) / 2;  // as in Blinn's and Phong's models, without cancellation
    const Real limit = (is_phong ? 6 : 2) * std::sqrt(shininess) * 0x1p-24L / glm::length(sum);
    return {std::exp(shininess * std::log1p(-one_minus_cosine)), limit + 0x1p-24L};
}

void append(std::vector<double>& rows, const std::vector<Highlight>& points, glm::vec3 Highlight::*member) {
    for (int component = 0; component < 3; ++component)
        for (const Highlight& point : points) rows.push_back((point.*member)[component]);
}

evaluate::Invocations invocations_of(const std::vector<Highlight>& points, Real shininess) {
    evaluate::Invocations invocations;
    invocations.count = points.size();
    append(invocations.values["eyeNormal"], points, &Highlight::normal);
    append(invocations.values["eyePosition"], points, &Highlight::position);
    append(invocations.values["DirectionalLights.lights[0].direction"], points, &Highlight::to_light);
    invocations.values["DirectionalLights.lights[0].color"] = {1, 1, 1};
    invocations.values["Material.shininess"] = {static_cast<double>(shininess)};
    invocations.values["Material.strength"] = {1};
    invocations.values["Material.specular"] = {1, 1, 1};
    return invocations;
}

/// The largest error, as a multiple of the limit.
Real largest_error(const std::string& specular, Real shininess, sanitize::Machine machine) {
    const LitUnderTest lit(
        "directional == 1 && fog == none && shading == fragment && specular == " + specular,
        {"directional", "fog", "shading", "specular"}, {});
    EXPECT_EQ(lit.size(), 1U);
    Highlights highlights;
    std::vector<Highlight> points;
    for (int i = 0; i < 40000; ++i) points.push_back(highlights.make(shininess));
    const auto outputs = evaluate::run<float>(lit.fragment(0), invocations_of(points, shininess),
                                              sanitize::options_of(machine));
    EXPECT_TRUE(outputs);
    if (!outputs) return 1e9L;
    Real largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Exact exact = exact_of(points[i], shininess, specular == "phong");
        const Real error = std::abs(outputs->values.at("fragmentColor")[i] - exact.factor);
        largest = std::max(largest, error / exact.limit);
    }
    return largest;
}

struct Row {
    const char* specular;
    double shininess;
};

class SharpHighlight : public testing::TestWithParam<Row> {};

TEST_P(SharpHighlight, IsTrueToTheRoundingOfItsDirections) {
    for (const sanitize::Machine machine :
         {sanitize::Machine::ieee, sanitize::Machine::flushed, sanitize::Machine::fused,
          sanitize::Machine::regrouped, sanitize::Machine::reordered})
        EXPECT_LE(largest_error(GetParam().specular, GetParam().shininess, machine), 1)
            << sanitize::name_of(machine);
}

INSTANTIATE_TEST_SUITE_P(Models, SharpHighlight,
                         testing::Values(Row{"blinn", 1e4}, Row{"blinn", 1e5}, Row{"blinn", 1e6},
                                         Row{"phong", 1e4}, Row{"phong", 1e5}, Row{"phong", 1e6}),
                         [](const auto& row) {
                             return std::string(row.param.specular) + "_" +
                                    std::to_string(static_cast<int>(row.param.shininess));
                         });

}  // namespace
}  // namespace gobo
