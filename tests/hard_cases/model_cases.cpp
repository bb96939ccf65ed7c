// The hard cases of model matrices.

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gobo/normal_matrix.hpp>

#include "lit_cases.hpp"

namespace gobo {
namespace {

const Inputs kNoLight = {{"DirectionalLights.lights[].color", {0, 0, 0}},
                         {"PointLights.lights[].color", {0, 0, 0}},
                         {"SpotLights.lights[].color", {0, 0, 0}}};

// Directions that are unit to 2e-7; the shiniest ordinary material has 8, and a handful of roundings follows.
constexpr double kByDirection = 1e-5;

template <class Matrix>
std::vector<double> numbers_of(const Matrix& matrix) {
    std::vector<double> numbers;
    for (int column = 0; column < Matrix::length(); ++column)
        for (int row = 0; row < Matrix::col_type::length(); ++row) numbers.push_back(matrix[column][row]);
    return numbers;
}

std::vector<double> numbers_of(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

/// A model of that scale along axes that are neither its own nor the viewer's, against an unscaled one that
/// has the same normal in eye space: the exact inverse of rotation, inverse scale, rotation.
Case scaled(const std::string& name, const glm::dvec3& scale) {
    const glm::dmat3 left(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3)));
    const glm::dmat3 right(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(-2, 1, 0.5)));
    glm::dvec3 normal(0.36, 0.48, 0.8);
    glm::dvec3 seen = glm::normalize(left * ((right * normal) / scale));
    if (seen.z < 0) {  // towards the lights
        normal = -normal;
        seen = -seen;
    }
    glm::dmat4 model(left * glm::dmat3(glm::scale(glm::dmat4(1), scale)) * right);
    model[3] = glm::dvec4(0, 0, -5, 1);
    return {name,
            {"extreme scale"},
            "directional + point + spot > 0",
            {{{"position", {0, 0, 0}},
              {"normal", numbers_of(normal)},
              {"Transform.modelView", numbers_of(model)},
              {"Transform.normalMatrix", numbers_of(normal_matrix(model))}}},
            same_as({{"position", {0, 0, -5}},
                     {"normal", numbers_of(seen)},
                     {"Transform.modelView", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                     {"Transform.normalMatrix", {1, 0, 0, 0, 1, 0, 0, 0, 1}}},
                    kByDirection)};
}

}  // namespace

std::vector<Case> model_cases() {
    return {
        {"nothing_left",
         {"singular model matrix"},
         "",
         {{{"Transform.modelView", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -5, 1}},
           {"Transform.normalMatrix", {0, 0, 0, 0, 0, 0, 0, 0, 0}}}},
         same_as(with(kNoLight, {{"position", {0, 0, 0}}}))},
        {"flattened",
         {"singular model matrix"},
         "",
         {{{"position", {1, 2, 3}},
           {"Transform.modelView", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, -5, 1}},
           {"Transform.normalMatrix", {0, 0, 0, 0, 0, 0, 0, 0, 1}}}},
         near_double(kByDirection)},
        scaled("ten_thousand_times_as_long", {1, 1, 1e4}),
        scaled("ten_thousand_times_as_wide", {1e4, 1, 1e4}),
        scaled("of_three_sizes", {1, 100, 1e4}),
    };
}

}  // namespace gobo
