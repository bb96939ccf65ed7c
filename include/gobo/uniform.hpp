// Uniforms outside blocks, samplers and vertex attributes, as generated headers name them.
// <gobo/gl_uniforms.hpp> and <gobo/gl_vertices.hpp> set them. No OpenGL.
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

/// A sampler of the header that Tables belong to, or an array of `Count`: the texture unit that
/// build_program() gives it (an array's first one), as which it can be used. `Target` is what glBindTexture()
/// calls textures for it, 0 for what takes no texture.
template <class Tables, unsigned Target, int Count = 1>
struct SamplerPlace {
    static constexpr unsigned target = Target;
    static constexpr int count = Count;
    int row;  ///< among Tables::samplers
    int unit;

    constexpr operator int() const { return unit; }
};

/// A vertex attribute: its location (of an array or a matrix the first one), as which it can be used. `Value`
/// is a number or a vector or matrix of std140.
template <class Value, int Count = 1>
struct AttributePlace {
    int location;

    constexpr operator int() const { return location; }
};

/// The locations in a program of what Tables::uniforms and Tables::samplers list; -1 for what the program
/// does not have.
template <class Tables>
struct Locations {
    std::array<int, Tables::uniforms.size()> numbers;
    std::array<int, Tables::samplers.size()> samplers;
};

/// What glBindTexture() calls the kinds of textures.
namespace target {
inline constexpr unsigned texture_1d = 0x0DE0;
inline constexpr unsigned texture_2d = 0x0DE1;
inline constexpr unsigned texture_3d = 0x806F;
inline constexpr unsigned texture_cube = 0x8513;
inline constexpr unsigned texture_rectangle = 0x84F5;
inline constexpr unsigned texture_1d_array = 0x8C18;
inline constexpr unsigned texture_2d_array = 0x8C1A;
inline constexpr unsigned texture_buffer = 0x8C2A;
inline constexpr unsigned texture_cube_array = 0x9009;
inline constexpr unsigned texture_2d_multisample = 0x9100;
inline constexpr unsigned texture_2d_multisample_array = 0x9102;
}  // namespace target

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
