#include "lab/render/source.hpp"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gobo {
namespace {

std::vector<double> fit(const glm::dmat4& matrix, const ValueType& type) {
    std::vector<double> numbers;
    for (int column = 0; column < type.columns; ++column)
        for (int row = 0; row < type.rows; ++row) numbers.push_back(matrix[column][row]);
    return numbers;
}

std::vector<double> fit(const glm::dvec4& vector, const ValueType& type) {
    std::vector<double> numbers;
    for (int row = 0; row < type.rows; ++row) numbers.push_back(vector[row]);
    return numbers;
}

std::optional<glm::dmat4> matrix_of(std::string_view source, const ViewedObject& object) {
    const glm::dmat4 model_view = object.view * object.model;
    if (source == "model") return object.model;
    if (source == "view") return object.view;
    if (source == "projection") return object.projection;
    if (source == "model_view") return model_view;
    if (source == "view_projection") return object.projection * object.view;
    if (source == "model_view_projection") return object.projection * model_view;
    if (source == "inverse_view") return glm::inverse(object.view);
    if (source == "normal_matrix") return glm::dmat4(normal_matrix(model_view));
    if (source == "world_normal_matrix") return glm::dmat4(normal_matrix(object.model));
    return std::nullopt;
}

std::optional<glm::dvec4> vector_of(std::string_view source, const std::vector<double>& numbers,
                                    const ViewedObject& object) {
    if (source == "camera_position") return glm::inverse(object.view)[3];
    if (source == "viewport") return glm::dvec4(object.viewport, 0, 1);
    if (numbers.size() < 3 || numbers.size() > 4) return std::nullopt;
    const glm::dvec3 xyz(numbers[0], numbers[1], numbers[2]);
    if (source == "eye_point") return object.view * glm::dvec4(xyz, numbers.size() == 4 ? numbers[3] : 1.0);
    if (source == "eye_direction" && glm::length(xyz) > 0)
        return glm::dvec4(glm::normalize(glm::dmat3(object.view) * xyz), 0);
    return std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> source_value(std::string_view source, const std::vector<double>& numbers,
                                                const ViewedObject& object, const ValueType& type) {
    if (const auto matrix = matrix_of(source, object))
        return type.is_matrix() ? std::optional(fit(*matrix, type)) : std::nullopt;
    if (const auto vector = vector_of(source, numbers, object))
        return !type.is_matrix() && type.rows > 1 ? std::optional(fit(*vector, type)) : std::nullopt;
    return std::nullopt;
}

}  // namespace gobo
