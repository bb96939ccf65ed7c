#include "lab/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gobo {
namespace {

double largest_entry(const glm::dmat3& matrix) {
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
    return largest;
}

}  // namespace

glm::dmat4 Camera::view() const {
    return glm::lookAt(position, target, up);
}

glm::dmat4 Camera::projection(double aspect) const {
    return glm::perspective(field_of_view, aspect, near_plane, far_plane);
}

glm::dmat4 vulkan_clip_space_of_maps() {
    glm::dmat4 matrix(1);
    matrix[2][2] = 0.5;  // z' = z / 2 + w / 2
    matrix[3][2] = 0.5;
    return matrix;
}

glm::dmat4 vulkan_clip_space_of_pictures() {
    glm::dmat4 matrix = vulkan_clip_space_of_maps();
    matrix[1][1] = -1;
    return matrix;
}

glm::dmat3 normal_matrix(const glm::dmat4& matrix) {
    const double scale = largest_entry(glm::dmat3(matrix));
    if (!(scale > 0) || std::isinf(scale)) return glm::dmat3(1);
    // Scaled first, so that products of three entries neither overflow nor vanish.
    const glm::dmat3 scaled = glm::dmat3(matrix) / scale;
    const glm::dmat3 cofactors(glm::cross(scaled[1], scaled[2]), glm::cross(scaled[2], scaled[0]),
                               glm::cross(scaled[0], scaled[1]));
    const double determinant = glm::dot(scaled[0], cofactors[0]);
    const double factor = 1 / (determinant * scale);
    const double size = largest_entry(cofactors);
    const double length = size * std::abs(factor);
    if (length < std::numeric_limits<float>::max() && length > std::numeric_limits<float>::min())
        return cofactors * factor;
    const double sign = determinant < 0 ? -1.0 : 1.0;
    return size > 0 ? cofactors * (sign / size) : glm::dmat3(1);
}

}  // namespace gobo
