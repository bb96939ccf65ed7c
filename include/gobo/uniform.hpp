// Uniforms outside blocks, as generated headers name them. <gobo/gl.hpp> sets them. No OpenGL.
#pragma once

#include <array>
#include <type_traits>

#include <gobo/std140.hpp>

namespace gobo {

/// A uniform of the header that Tables belong to: where its location stands among Locations. `Value` is a
/// number, a bool, or a vector or matrix of std140; `Count` how many elements the array has.
template <class Tables, class Value, int Count = 1>
struct UniformPlace {
    int row;
};

/// The locations in a program of what Tables::uniforms lists; -1 for what the program does not have.
template <class Tables>
struct Locations {
    std::array<int, Tables::uniforms.size()> numbers;
};

namespace runtime {

/// Whether a value of the application's type is what the uniform takes: the type itself, or GLM's of the same
/// shape in another layout. No conversion between numbers is made.
template <class Value, class Given>
struct TakesValue : std::is_same<Value, Given> {};
template <int Length, class Number, glm::qualifier Left, glm::qualifier Right>
struct TakesValue<glm::vec<Length, Number, Left>, glm::vec<Length, Number, Right>> : std::true_type {};
template <int Columns, int Rows, class Number, glm::qualifier Left, glm::qualifier Right>
struct TakesValue<glm::mat<Columns, Rows, Number, Left>, glm::mat<Columns, Rows, Number, Right>>
    : std::true_type {};

/// What OpenGL takes for a value: its components, bools as ints.
template <class Value>
struct NumbersOf {
    using Number = Value;
    static constexpr int columns = 1;
    static constexpr int rows = 1;
    static void copy(const Value& value, Number* to) { *to = value; }
};
template <>
struct NumbersOf<bool> {
    using Number = std::int32_t;
    static constexpr int columns = 1;
    static constexpr int rows = 1;
    static void copy(bool value, Number* to) { *to = value ? 1 : 0; }
};
template <int Length, class Component, glm::qualifier Layout>
struct NumbersOf<glm::vec<Length, Component, Layout>> {
    using Number = typename NumbersOf<Component>::Number;
    static constexpr int columns = 1;
    static constexpr int rows = Length;
    static void copy(const glm::vec<Length, Component, Layout>& value, Number* to) {
        for (int row = 0; row < Length; ++row) NumbersOf<Component>::copy(value[row], to + row);
    }
};
template <int Columns, int Rows, class Component, glm::qualifier Layout>
struct NumbersOf<glm::mat<Columns, Rows, Component, Layout>> {
    using Number = Component;
    static constexpr int columns = Columns;
    static constexpr int rows = Rows;
    static void copy(const glm::mat<Columns, Rows, Component, Layout>& value, Number* to) {
        for (int column = 0; column < Columns; ++column)
            for (int row = 0; row < Rows; ++row) to[column * Rows + row] = value[column][row];
    }
};

}  // namespace runtime
}  // namespace gobo
