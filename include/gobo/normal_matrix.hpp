// The matrix that takes normals where a model-view matrix takes positions, computed in double on the CPU.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gobo {

/// The cofactors of the model-view matrix's upper left 3x3: the inverse transpose times the determinant,
/// a factor that does not change directions. They exist for singular matrices too: a flattened model keeps
/// the normal of its plane; where nothing is left the matrix is zero, and so are its normals. Divided by
/// the largest component, so that no model is too large or too small for single precision. A mirrored
/// model's determinant is negative; the sign is corrected, so that normals stay on their side of the surface.
///
/// Precision: normals are true to 1e-5 at scales of 1 : 1e4 along the object's axes. Along any other axes the
/// matrix shortens some normals far more than others, and what single precision holds of it is off by 3e-7 of
/// the longest. The same cofactors computed in single precision are off by a thousand times as much, since
/// differences of products cancel. Give it the model-view matrix in double precision as well: what was lost
/// before cannot be recovered.
///
/// Source: cofactors as the normal transform, e.g. Pharr, Jakob, Humphreys, Physically Based
/// Rendering, 2.8.2.
template <class Number, glm::qualifier Layout>
[[nodiscard]] inline glm::mat3 normal_matrix(const glm::mat<4, 4, Number, Layout>& model_view) {
    const glm::dvec3 x(model_view[0][0], model_view[0][1], model_view[0][2]);
    const glm::dvec3 y(model_view[1][0], model_view[1][1], model_view[1][2]);
    const glm::dvec3 z(model_view[2][0], model_view[2][1], model_view[2][2]);
    const auto size_of = [](const glm::dvec3& axis) {
        return (std::max)(std::abs(axis.x), (std::max)(std::abs(axis.y), std::abs(axis.z)));
    };
    const double size = (std::max)(size_of(x), (std::max)(size_of(y), size_of(z)));
    if (!(size > 0)) return glm::mat3(0.0F);
    const glm::dvec3 a = x / size;  // so that products neither over- nor underflow
    const glm::dvec3 b = y / size;
    const glm::dvec3 c = z / size;
    glm::dmat3 cofactors(glm::cross(b, c), glm::cross(c, a), glm::cross(a, b));
    if (glm::dot(a, cofactors[0]) < 0) cofactors = -cofactors;  // mirrored
    double largest = 0;
    for (int column = 0; column < 3; ++column) largest = (std::max)(largest, size_of(cofactors[column]));
    if (!(largest > 0)) return glm::mat3(0.0F);
    return glm::mat3(cofactors / largest);
}

}  // namespace gobo
