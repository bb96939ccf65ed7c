// Normal matrices against ones known in closed form: a rotation, a scale and a rotation have the inverse
// transpose of rotation, inverse scale, rotation (singular model matrix, mirrored model, extreme scale).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gobo/normal_matrix.hpp>
#include <gtest/gtest.h>

namespace {

class Models {
  public:
    glm::dvec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(glm::dvec3(normal(engine_), normal(engine_), normal(engine_)));
    }
    glm::dmat3 rotation() {
        std::uniform_real_distribution<double> angle(0, 6.28);
        return glm::dmat3(glm::rotate(glm::dmat4(1), angle(engine_), direction()));
    }

  private:
    std::mt19937_64 engine_{1};
};

glm::dmat3 scale(const glm::dvec3& by) {
    return {glm::dvec3(by.x, 0, 0), glm::dvec3(0, by.y, 0), glm::dvec3(0, 0, by.z)};
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The cofactors as a shader would compute them from its uniform, all in single precision.
glm::mat3 plain_cofactors(const glm::mat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

struct Errors {
    double ours = 0;
    double shortened = 0;  ///< ours, times the share of its length that the matrix leaves the normal
    double plain = 0;
};

enum class Axes { of_the_object, any };

/// The largest angles, in radians, by which normals are off over random models of that scale. Scales are
/// along the object's axes, or along any (as under a parent that is scaled).
Errors largest_errors(const glm::dvec3& by, Axes axes) {
    Models models;
    Errors largest;
    const double sign = by.x * by.y * by.z < 0 ? -1 : 1;
    const glm::dvec3 inverse = 1.0 / by;
    const double longest = std::max({std::abs(inverse.x), std::abs(inverse.y), std::abs(inverse.z)});
    for (int i = 0; i < 20000; ++i) {
        const glm::dmat3 left = models.rotation();
        const glm::dmat3 right = axes == Axes::any ? models.rotation() : glm::dmat3(1);
        const glm::dmat3 model = left * scale(by) * right;
        const glm::vec3 normal(models.direction());
        const glm::dvec3 exact = left * scale(inverse) * right * glm::dvec3(normal);
        // What the vertex stage computes of it: a product in single precision.
        const glm::vec3 single = gobo::normal_matrix(glm::dmat4(model)) * normal;
        const double error = angle_between(glm::dvec3(single), exact);
        largest.ours = std::max(largest.ours, error);
        largest.shortened = std::max(largest.shortened, error * glm::length(exact) / longest);
        const glm::vec3 plain = plain_cofactors(glm::mat3(model)) * normal;
        largest.plain = std::max(largest.plain, angle_between(sign * glm::dvec3(plain), exact));
    }
    return largest;
}

const glm::dvec3 kScales[] = {{1, 1, 1}, {1, 1, 1e4}, {1e4, 1, 1e4}, {1, 100, 1e4}};

TEST(NormalMatrix, IsTrueTo1e5AtScalesOf1To1e4) {
    for (const glm::dvec3& by : kScales)
        EXPECT_LE(largest_errors(by, Axes::of_the_object).ours, 1e-5) << by.x << ", " << by.y << ", " << by.z;
}

/// Scaled along other axes than its own, a matrix shortens some normals by nearly 1e4 times more than others.
/// What a uniform of single precision holds is then off by a rounding of the longest, which counts the more
/// the shorter a normal gets: 1e-5 up to thirty times shorter.
TEST(NormalMatrix, IsAsTrueAsAUniformHoldsItAlongAnyAxes) {
    for (const glm::dvec3& by : kScales)
        EXPECT_LE(largest_errors(by, Axes::any).shortened, 3e-7) << by.x << ", " << by.y << ", " << by.z;
}

/// What it is for: cofactors of a matrix in single precision. The axes of a model that is long along another
/// axis are nearly parallel, and their cross products cancel.
TEST(NormalMatrix, PlainCofactorsAreOff) {
    double largest = 0;
    for (const glm::dvec3& by : kScales) {
        const Errors errors = largest_errors(by, Axes::any);
        std::printf("scaled by (%g, %g, %g): ours %.2g, in single precision %.2g radians\n", by.x, by.y, by.z,
                    errors.ours, errors.plain);
        largest = std::max(largest, errors.plain);
    }
    EXPECT_GT(largest, 1e-3);  // and without bound for normals that the matrix shortens most
}

TEST(NormalMatrix, TakesModelsOfAnySize) {
    for (const double size : {1e-6, 1e6})
        EXPECT_LE(largest_errors(glm::dvec3(size, size, size * 1e4), Axes::of_the_object).ours, 1e-5) << size;
}

/// The determinant is negative: a cofactor matrix alone would turn the normals over.
TEST(NormalMatrix, KeepsTheSideOfMirroredModels) {
    EXPECT_LE(largest_errors({-1, 1, 1}, Axes::of_the_object).ours, 1e-5);
    EXPECT_LE(largest_errors({-1, -2, -1e4}, Axes::of_the_object).ours, 1e-5);
    const glm::mat3 mirrored = gobo::normal_matrix(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)));
    EXPECT_EQ(mirrored * glm::vec3(0, 0, 1), glm::vec3(0, 0, 1));
    EXPECT_EQ(mirrored * glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0));
}

TEST(NormalMatrix, OfAFlattenedModelKeepsThePlanesNormal) {
    const glm::mat3 flat = gobo::normal_matrix(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0)));
    EXPECT_EQ(flat * glm::vec3(0.6F, 0, 0.8F), glm::vec3(0, 0, 0.8F));
}

TEST(NormalMatrix, OfNothingIsZero) {
    for (const glm::dvec3& by : {glm::dvec3(0), glm::dvec3(1, 0, 0)})
        EXPECT_EQ(gobo::normal_matrix(glm::scale(glm::dmat4(1), by)), glm::mat3(0));
}

/// Translation and a matrix in single precision do no harm.
TEST(NormalMatrix, LooksAtTheUpperLeft3x3Alone) {
    const glm::mat4 moved = glm::translate(glm::mat4(1), glm::vec3(1e6F, -1e6F, 3));
    EXPECT_EQ(gobo::normal_matrix(moved), glm::mat3(1));
}

}  // namespace
