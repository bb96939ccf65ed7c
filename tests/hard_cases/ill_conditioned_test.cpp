// Hard cases (small exponent beside a right angle, large world): what is lost there is what rounding the
// inputs loses, and how an application keeps clear of it.
#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "lab/verify/random_points.hpp"
#include "lab/verify/stage_check.hpp"
#include "lit_under_test.hpp"

namespace gobo {
namespace {

struct Losses {
    double largest = 0;    ///< of a float evaluation's errors
    double explained = 0;  ///< the most that inputs moved by one ulp change the answer in double precision
};

/// Of one output's first component, whose values are at most about 1 where they matter.
Losses losses_of(const evaluate::Program& program, const std::string& output,
                 const evaluate::Invocations& points) {
    const auto exact = verify::in_double(program, points);
    const auto in_float = evaluate::run<float>(program, points);
    Losses losses;
    EXPECT_TRUE(exact && in_float);
    if (!exact || !in_float) return losses;
    constexpr double kUlp = 2 * verify::kRoundingStep;
    for (const std::uint64_t seed :
         {1, 11, 21, 31, 41, 51, 61, 71}) {  // either side of the right angle is met
        const auto widest = verify::spread(program, points, *exact, kUlp, seed).value();
        for (std::size_t i = 0; i < points.count; ++i)
            losses.explained = std::max(losses.explained, widest.at(output)[i]);
    }
    for (std::size_t i = 0; i < points.count; ++i) {
        const double error = std::abs(in_float->values.at(output)[i] - exact->at(output)[i]);
        losses.largest = std::max(losses.largest, error);
    }
    return losses;
}

void append(std::vector<double>& rows, const std::vector<glm::dvec3>& vectors) {
    for (int component = 0; component < 3; ++component)
        for (const glm::dvec3& vector : vectors) rows.push_back(static_cast<float>(vector[component]));
}

/// Phong's highlight where the cosine of its angle is 1e-9 to 1e-2, of surfaces in any direction.
evaluate::Invocations beside_a_right_angle(double shininess) {
    std::mt19937_64 engine{1};
    std::normal_distribution<double> number;
    std::uniform_real_distribution<double> unit;
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(number(engine), number(engine), number(engine)));
    };
    std::vector<glm::dvec3> normals, positions, lights;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 normal = direction();
        const glm::dvec3 aside = glm::normalize(glm::cross(normal, direction()));
        const double angle = 1.2 * unit(engine);
        const glm::dvec3 mirrored = std::cos(angle) * normal - std::sin(angle) * aside;
        const double cosine = std::pow(10, -9 + 7 * unit(engine));
        const glm::dvec3 across = glm::normalize(glm::cross(mirrored, direction()));
        normals.push_back(normal);
        positions.push_back(-3.0 * (cosine * mirrored + std::sqrt(1 - cosine * cosine) * across));
        lights.push_back(std::cos(angle) * normal + std::sin(angle) * aside);
    }
    evaluate::Invocations points;
    points.count = normals.size();
    append(points.values["eyeNormal"], normals);
    append(points.values["eyePosition"], positions);
    append(points.values["DirectionalLights.lights[0].direction"], lights);
    points.values["DirectionalLights.lights[0].color"] = {1, 1, 1};
    points.values["Material.shininess"] = {static_cast<float>(shininess)};
    points.values["Material.strength"] = {1};
    points.values["Material.specular"] = {1, 1, 1};
    return points;
}

struct Exponent {
    const char* name;
    double shininess;
    double at_least;
    double at_most;
};

class SmallExponent : public testing::TestWithParam<Exponent> {};

TEST_P(SmallExponent, LosesWhatRoundingItsDirectionsLoses) {
    const LitUnderTest lit("directional == 1 && fog == none && shading == fragment && specular == phong",
                           {"directional", "fog", "shading", "specular"}, {});
    ASSERT_EQ(lit.size(), 1U);
    const Losses losses =
        losses_of(lit.fragment(0), "fragmentColor", beside_a_right_angle(GetParam().shininess));
    EXPECT_LE(losses.largest, losses.explained);
    EXPECT_GE(losses.largest, GetParam().at_least);
    EXPECT_LE(losses.largest, GetParam().at_most);
}

/// The cosine between the mirrored light and the viewer, by products of components.
template <class T>
T cosine_of_highlight(const evaluate::Invocations& points, std::size_t i) {
    const auto vector = [&](const char* name) {
        const std::vector<double>& rows = points.values.at(name);
        return glm::vec<3, T>(rows[i], rows[points.count + i], rows[2 * points.count + i]);
    };
    const glm::vec<3, T> mirrored =
        glm::reflect(-vector("DirectionalLights.lights[0].direction"), glm::normalize(vector("eyeNormal")));
    return std::max(glm::dot(mirrored, glm::normalize(-vector("eyePosition"))), T(0));
}

/// The logarithm of the cosine itself, instead of one by 1 - cos, is no cure.
TEST_P(SmallExponent, LosesAsMuchByTheCosineItself) {
    const double shininess = static_cast<float>(GetParam().shininess);
    const evaluate::Invocations points = beside_a_right_angle(shininess);
    double largest = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        const double in_float = cosine_of_highlight<float>(points, i);
        const double lost = std::abs(std::pow(in_float, shininess) -
                                     std::pow(cosine_of_highlight<double>(points, i), shininess));
        largest = std::max(largest, lost);
    }
    EXPECT_GE(largest, GetParam().at_least);
}

INSTANTIATE_TEST_SUITE_P(Rows, SmallExponent,
                         testing::Values(Exponent{"a_tenth", 0.1, 0.05, 0.25},
                                         Exponent{"a_half", 0.5, 1e-4, 1e-3}, Exponent{"one", 1, 0, 2e-6},
                                         Exponent{"eight", 8, 0, 1e-7}),
                         [](const auto& row) { return row.param.name; });

/// A point 0.32 from a light, before a viewer who stands that far from the world's origin.
struct World {
    double size = 0;
    glm::dvec3 origin{0};  ///< of the object's coordinates, in the world

    [[nodiscard]] evaluate::Invocations point() const {
        const glm::dmat3 turn(std::sqrt(0.75), 0, -0.5, 0, 1, 0, 0.5, 0, std::sqrt(0.75));  // by columns
        const glm::dvec3 viewer(size + 0.25, 10.125, 0.7 * size + 0.375);
        const glm::dvec3 position = viewer + glm::dvec3(0.2, -0.5, -2) * turn - origin;
        const glm::dvec3 shift = turn * (origin - viewer);
        evaluate::Invocations point;
        point.count = 1;
        point.values["position"] = {position.x, position.y, position.z};
        point.values["normal"] = {0, 1, 0};
        std::vector<double>& matrix = point.values["Transform.modelView"];
        for (int column = 0; column < 3; ++column)
            matrix.insert(matrix.end(), {turn[column].x, turn[column].y, turn[column].z, 0});
        matrix.insert(matrix.end(), {shift.x, shift.y, shift.z, 1});
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                point.values["Transform.normalMatrix"].push_back(turn[column][row]);
        point.values["Transform.projection"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
        point.values["PointLights.lights[0].position"] = {0.5, -0.4, -2, 1};
        point.values["PointLights.lights[0].color"] = {0.1, 0.1, 0.1};
        point.values["PointLights.lights[0].attenuation"] = {0, 0, 1};
        point.values["Material.diffuse"] = {1, 1, 1};
        return point;
    }
};

evaluate::Invocations in_floats(evaluate::Invocations point) {
    for (auto& [name, numbers] : point.values)
        for (double& number : numbers) number = static_cast<float>(number);
    return point;
}

struct WorldRow {
    const char* name;
    double size;
    double
        from_world;  ///< at least so much of the light is lost where positions count from the world's origin
    double from_object;  ///< at most so much where they count from a corner nearby
};

class LargeWorld : public testing::TestWithParam<WorldRow> {};

TEST_P(LargeWorld, IsLitRightFromAnOriginNearby) {
    const LitUnderTest lit("point == 1 && fog == none && shading == vertex && specular == none",
                           {"point", "fog", "shading", "specular"}, {});
    ASSERT_EQ(lit.size(), 1U);
    const evaluate::Program& program = lit.vertex(0);
    const World in_world{GetParam().size, glm::dvec3(0)};
    const World nearby{GetParam().size, {GetParam().size, 0, 0.7 * GetParam().size}};
    const double right =
        evaluate::run<double>(program, in_world.point()).value().values.at("litRadiance").front();
    const auto lost = [&](const World& world) {
        const auto outputs = evaluate::run<float>(program, in_floats(world.point())).value();
        return std::abs(outputs.values.at("litRadiance").front() - right) / right;
    };
    EXPECT_GE(lost(in_world), GetParam().from_world);
    EXPECT_LE(lost(nearby), GetParam().from_object);
    const Losses losses = losses_of(program, "litRadiance", in_floats(in_world.point()));
    EXPECT_LE(losses.largest, losses.explained);
}

INSTANTIATE_TEST_SUITE_P(Rows, LargeWorld,
                         testing::Values(WorldRow{"of_1e4", 1e4, 1e-4, 1e-5},
                                         WorldRow{"of_1e5", 1e5, 1e-3, 1e-5},
                                         WorldRow{"of_1e6", 1e6, 1e-2, 1e-5}),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
