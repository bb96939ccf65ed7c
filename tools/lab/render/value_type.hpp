// GLSL's scalar, vector and matrix types, with OpenGL's numbers for them.
#pragma once

#include <optional>
#include <string_view>

namespace gobo {

enum class Component { float32, float64, int32, uint32, boolean };

/// The shape of a value. A vector is one column; a scalar is one column of one row.
struct ValueType {
    std::string_view name;  ///< GLSL's: "vec3", "mat2x3" (two columns of three rows)
    unsigned enumerant;     ///< OpenGL's: GL_FLOAT_VEC3
    Component component;
    int columns;
    int rows;

    [[nodiscard]] bool is_matrix() const { return columns > 1; }
    [[nodiscard]] int components() const { return columns * rows; }
};

/// The type of that GLSL name or OpenGL enumerant; nothing for samplers, structs and unknown ones.
[[nodiscard]] std::optional<ValueType> value_type(std::string_view name);
[[nodiscard]] std::optional<ValueType> value_type(unsigned enumerant);

/// GLSL's name of a sampler type's OpenGL enumerant; empty where it is none.
[[nodiscard]] std::string_view sampler_type_name(unsigned enumerant);

}  // namespace gobo
