// Members of uniform blocks as std140 lays them out, and of storage blocks as std430 does: GLM types, and
// padded ones where GLM's have no padding. Each is plain data that memcpy takes to a buffer, and converts
// from and to GLM's own type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <glm/mat2x2.hpp>
#include <glm/mat2x3.hpp>
#include <glm/mat2x4.hpp>
#include <glm/mat3x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat3x4.hpp>
#include <glm/mat4x2.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gobo::std140 {

/// glm::vec2 and so on in GLM's packed layout: the very same types, unless the application defines
/// GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, which would change their sizes.
template <int Length, class Number>
using Vector = glm::vec<Length, Number, glm::packed_highp>;
template <int Columns, int Rows, class Number>
using PlainMatrix = glm::mat<Columns, Rows, Number, glm::packed_highp>;

using vec2 = Vector<2, float>;
using vec3 = Vector<3, float>;
using vec4 = Vector<4, float>;
using ivec2 = Vector<2, std::int32_t>;
using ivec3 = Vector<3, std::int32_t>;
using ivec4 = Vector<4, std::int32_t>;
using uvec2 = Vector<2, std::uint32_t>;
using uvec3 = Vector<3, std::uint32_t>;
using uvec4 = Vector<4, std::uint32_t>;
using dvec2 = Vector<2, double>;
using dvec3 = Vector<3, double>;
using dvec4 = Vector<4, double>;
using mat4 = PlainMatrix<4, 4, float>;

/// The type of GLM's that an application knows the value by: glm::vec2 and so on, which is another type than
/// ours where it defines GLM_FORCE_DEFAULT_ALIGNED_GENTYPES.
template <class Value>
struct Named {
    using Type = Value;
};
template <int Length, class Number>
struct Named<Vector<Length, Number>> {
    using Type = glm::vec<Length, Number, glm::defaultp>;
};

/// A value and the padding up to `Bytes`: an element of an array, whose stride is 16 at least.
template <class Value, std::size_t Bytes>
struct Padded {
    Value value;
    std::byte padding[Bytes - sizeof(Value)];

    Padded() = default;
    // Implicit, so that elements are assigned as if they were not padded.
    constexpr Padded(const Value& given) : value(given), padding{} {}
    constexpr operator const Value&() const { return value; }
    constexpr operator Value&() { return value; }
    // From and to the type that the application knows, where that is another.
    template <class Given, class = std::enable_if_t<std::is_same_v<Given, typename Named<Value>::Type> &&
                                                    !std::is_same_v<Given, Value>>>
    constexpr Padded(const Given& given) : value(given), padding{} {}
    template <class Wanted, class = std::enable_if_t<std::is_same_v<Wanted, typename Named<Value>::Type> &&
                                                     !std::is_same_v<Wanted, Value>>>
    constexpr operator Wanted() const {
        return Wanted(value);
    }
};

/// GLSL's bool: 32 bits, 0 or 1. (X11 makes `Bool` a macro.)
struct Bool32 {
    std::uint32_t value;

    Bool32() = default;
    constexpr Bool32(bool given) : value(given ? 1U : 0U) {}
    constexpr operator bool() const { return value != 0; }
};

/// An element of an array of bool, assigned and read as bool.
template <std::size_t Bytes>
struct Padded<Bool32, Bytes> {
    Bool32 value;
    std::byte padding[Bytes - sizeof(Bool32)];

    Padded() = default;
    constexpr Padded(bool given) : value(given), padding{} {}
    constexpr Padded(const Bool32& given) : value(given), padding{} {}
    constexpr operator bool() const { return value; }
    constexpr operator const Bool32&() const { return value; }
};

/// GLSL's bvec2, bvec3 and bvec4.
template <int Length>
struct BoolVector {
    Bool32 components[static_cast<std::size_t>(Length)];

    BoolVector() = default;
    template <class... Given, class = std::enable_if_t<sizeof...(Given) == Length &&
                                                       (std::is_convertible_v<Given, bool> && ...)>>
    constexpr BoolVector(Given... given) : components{Bool32(given)...} {}
    template <glm::qualifier Layout>
    constexpr BoolVector(const glm::vec<Length, bool, Layout>& given) : components{} {
        for (int index = 0; index < Length; ++index) components[index] = given[index];
    }
    template <glm::qualifier Layout>
    constexpr operator glm::vec<Length, bool, Layout>() const {
        glm::vec<Length, bool, Layout> result(false);
        for (int index = 0; index < Length; ++index) result[index] = components[index];
        return result;
    }
    constexpr Bool32& operator[](int index) { return components[index]; }
    constexpr const Bool32& operator[](int index) const { return components[index]; }
};
template <int Length>
struct Named<BoolVector<Length>> {
    using Type = glm::vec<Length, bool, glm::defaultp>;
};
using bvec2 = BoolVector<2>;
using bvec3 = BoolVector<3>;
using bvec4 = BoolVector<4>;

/// A column-major matrix whose columns are `Stride` bytes apart: in std140 each column is padded to 16.
template <int Columns, int Rows, class Number, std::size_t Stride>
struct Matrix {
    static_assert(Stride > static_cast<std::size_t>(Rows) * sizeof(Number),
                  "a matrix without padding is a PlainMatrix");
    using Column = Padded<Vector<Rows, Number>, Stride>;
    Column columns[static_cast<std::size_t>(Columns)];

    Matrix() = default;
    template <glm::qualifier Layout>
    constexpr Matrix(const glm::mat<Columns, Rows, Number, Layout>& given) : columns{} {
        for (int column = 0; column < Columns; ++column)
            columns[column].value = Vector<Rows, Number>(given[column]);
    }
    template <glm::qualifier Layout>
    constexpr operator glm::mat<Columns, Rows, Number, Layout>() const {
        glm::mat<Columns, Rows, Number, Layout> result(Number(1));
        for (int column = 0; column < Columns; ++column)
            result[column] = glm::vec<Rows, Number, Layout>(columns[column].value);
        return result;
    }
    constexpr Vector<Rows, Number>& operator[](int column) { return columns[column].value; }
    constexpr const Vector<Rows, Number>& operator[](int column) const { return columns[column].value; }
};
using Mat2 = Matrix<2, 2, float, 16>;
using Mat3 = Matrix<3, 3, float, 16>;

/// A matrix that the shader declares row_major: its rows stand in memory, `Stride` bytes apart. It converts
/// from and to GLM's column-major matrix of the same value, so nobody transposes by hand.
template <int Columns, int Rows, class Number, std::size_t Stride>
struct RowMajorMatrix {
    /// numbers[row][column]; the rest of each row is padding.
    Number numbers[static_cast<std::size_t>(Rows)][Stride / sizeof(Number)];

    RowMajorMatrix() = default;
    template <glm::qualifier Layout>
    constexpr RowMajorMatrix(const glm::mat<Columns, Rows, Number, Layout>& given) : numbers{} {
        for (int row = 0; row < Rows; ++row) {
            for (int column = 0; column < Columns; ++column) numbers[row][column] = given[column][row];
        }
    }
    template <glm::qualifier Layout>
    constexpr operator glm::mat<Columns, Rows, Number, Layout>() const {
        glm::mat<Columns, Rows, Number, Layout> result(Number(1));
        for (int row = 0; row < Rows; ++row) {
            for (int column = 0; column < Columns; ++column) result[column][row] = numbers[row][column];
        }
        return result;
    }
};

/// The elements of the array without a size that ends a storage block: a view of the application's buffer.
template <class Element>
class Elements {
  public:
    using Buffer = std::conditional_t<std::is_const_v<Element>, const void, void>;
    using Byte = std::conditional_t<std::is_const_v<Element>, const std::byte, std::byte>;

    /// As many as a buffer of so many bytes has from `offset` on.
    Elements(Buffer* buffer, std::size_t bytes, std::size_t offset)
        : first_(reinterpret_cast<Element*>(static_cast<Byte*>(buffer) + offset)),
          size_(bytes > offset ? (bytes - offset) / sizeof(Element) : 0) {}

    [[nodiscard]] Element* begin() const { return first_; }
    [[nodiscard]] Element* end() const { return first_ + size_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    Element& operator[](std::size_t index) const { return first_[index]; }

  private:
    Element* first_;
    std::size_t size_;
};

}  // namespace gobo::std140
