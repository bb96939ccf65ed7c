// The values that the renderer supplies by name: matrices, positions and directions of the view.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lab/render/transform.hpp"
#include "lab/render/value_type.hpp"

namespace gobo {

/// What values are made of: one object seen by one camera.
struct ViewedObject {
    glm::dmat4 model{1};        ///< object to world space
    glm::dmat4 view{1};         ///< world to eye space
    glm::dmat4 projection{1};   ///< eye to clip space
    glm::dvec2 viewport{1, 1};  ///< pixels
};

/// The numbers of a source for a uniform of the given type, in double precision, column by column. Nothing
/// where there is no such source, or it does not fit the type (a matrix for a vector).
///
/// | source | what |
/// |---|---|
/// | model, view, projection, model_view, view_projection, model_view_projection | matrices between the
/// spaces | | inverse_view | eye to world space | | normal_matrix | object-space normals to eye space | |
/// world_normal_matrix | object-space normals to world space | | camera_position | world space | | eye_point
/// | `numbers` are x, y, z[, w] in world space; given in eye space (w = 0 for a direction) | | eye_direction
/// | `numbers` are a direction in world space; given in eye space with unit length | | viewport | width and
/// height in pixels |
///
/// A 4 x 4 matrix gives a mat3 its upper left part; a mat3 fills a mat4 up from the identity.
[[nodiscard]] std::optional<std::vector<double>> source_value(std::string_view source,
                                                              const std::vector<double>& numbers,
                                                              const ViewedObject& object,
                                                              const ValueType& type);

/// The sources of uniforms, attributes and samplers, for suggestions.
[[nodiscard]] const std::vector<std::string>& uniform_sources();
[[nodiscard]] const std::vector<std::string>& attribute_sources();
[[nodiscard]] const std::vector<std::string>& texture_sources();

/// The source that a name's usual spelling tells; empty where it tells none. Only the last part of a member's
/// name counts. Blanks between words, a prefix (`u_`, `a_`, `in_`, `uMVP`, `aPosition`, ...) and "matrix" at
/// the end do not matter. The spellings are a table in source_spelling.cpp.
[[nodiscard]] std::string_view uniform_source_of(std::string_view name);
[[nodiscard]] std::string_view attribute_source_of(std::string_view name);

}  // namespace gobo
