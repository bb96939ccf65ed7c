// The scalars, vectors and matrices of GLSL: the one place that knows their names and sizes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// What one component of a value is. A boolean takes 32 bits in a block.
enum class Scalar : std::uint8_t {
    float32,
    int32,
    uint32,
    boolean,
    float64,
    float16,
    int8,
    uint8,
    int16,
    uint16,
    int64,
    uint64
};

[[nodiscard]] constexpr bool is_integer(Scalar scalar) {
    return scalar == Scalar::int32 || scalar == Scalar::uint32;
}

/// A scalar is one column of one row, a vector one column.
struct GlslType {
    Scalar scalar = Scalar::float32;
    int columns = 1;
    int rows = 1;

    /// "float", "ivec3", "mat2x3": two columns of three rows.
    [[nodiscard]] std::string name() const;
    [[nodiscard]] bool is_matrix() const { return columns > 1; }
    [[nodiscard]] int components() const { return columns * rows; }
    /// Bytes of one component, and of one column without padding.
    [[nodiscard]] int scalar_size() const;
    [[nodiscard]] int column_size() const { return rows * scalar_size(); }
    /// Bytes that std140 and std430 align a column to: three rows as four.
    [[nodiscard]] int column_alignment() const { return scalar_size() * (rows == 3 ? 4 : rows); }

    friend bool operator==(const GlslType&, const GlslType&) = default;
};

/// The type of that name, "mat3x3" for "mat3" too; nothing for samplers, structs and unknown names.
[[nodiscard]] std::optional<GlslType> glsl_type(std::string_view name);

/// The elements of an array of those extents; 1 where it is no array.
[[nodiscard]] int element_count(const std::vector<int>& extents);

/// "vec3[2][4]" of "vec3"; an extent of 0 as "[]".
[[nodiscard]] std::string with_extents(std::string name, const std::vector<int>& extents);

/// Locations between stages of a value of that type (GLSL 4.50, 4.4.1): one for each element and column.
[[nodiscard]] int location_count(std::string_view type, const std::vector<int>& extents);

}  // namespace gobo
