// Sets uniforms outside blocks by the typed places of a generated header, through whatever loader the
// application uses.
//
//     gobo::gl::Program program = gobo::gl::build_program(*p);
//     const auto locations = gobo::gl::find_locations(*p, program.id);       // once
//     glUseProgram(program.id);
//     gobo::gl::set(locations, game::uniform::tint, glm::vec3(1, 0, 0));     // another type does not compile
//     gobo::gl::set(locations, game::uniform::lights[2].radius, 5.0F);
//
// As in <gobo/gl.hpp>, a table of functions can be passed as a last argument.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include <gobo/gl.hpp>
#include <gobo/uniform.hpp>

namespace gobo::gl {

#ifndef GOBO_GL_NO_LOADER
/// The functions of the loader that set uniforms.
struct LoadedUniformFunctions : LoadedFunctions {
    void Uniform1fv(int location, int count, const float* values) const {
        glUniform1fv(location, count, values);
    }
    void Uniform2fv(int location, int count, const float* values) const {
        glUniform2fv(location, count, values);
    }
    void Uniform3fv(int location, int count, const float* values) const {
        glUniform3fv(location, count, values);
    }
    void Uniform4fv(int location, int count, const float* values) const {
        glUniform4fv(location, count, values);
    }
    void Uniform2iv(int location, int count, const int* values) const {
        glUniform2iv(location, count, values);
    }
    void Uniform3iv(int location, int count, const int* values) const {
        glUniform3iv(location, count, values);
    }
    void Uniform4iv(int location, int count, const int* values) const {
        glUniform4iv(location, count, values);
    }
    void Uniform1uiv(int location, int count, const unsigned* values) const {
        glUniform1uiv(location, count, values);
    }
    void Uniform2uiv(int location, int count, const unsigned* values) const {
        glUniform2uiv(location, count, values);
    }
    void Uniform3uiv(int location, int count, const unsigned* values) const {
        glUniform3uiv(location, count, values);
    }
    void Uniform4uiv(int location, int count, const unsigned* values) const {
        glUniform4uiv(location, count, values);
    }
    void UniformMatrix2fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix2fv(location, count, transpose, values);
    }
    void UniformMatrix3fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix3fv(location, count, transpose, values);
    }
    void UniformMatrix4fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix4fv(location, count, transpose, values);
    }
    void UniformMatrix2x3fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix2x3fv(location, count, transpose, values);
    }
    void UniformMatrix2x4fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix2x4fv(location, count, transpose, values);
    }
    void UniformMatrix3x2fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix3x2fv(location, count, transpose, values);
    }
    void UniformMatrix3x4fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix3x4fv(location, count, transpose, values);
    }
    void UniformMatrix4x2fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix4x2fv(location, count, transpose, values);
    }
    void UniformMatrix4x3fv(int location, int count, unsigned char transpose, const float* values) const {
        glUniformMatrix4x3fv(location, count, transpose, values);
    }
};
#endif

/// Where the program, built from the permutation, has each uniform outside blocks: asked of OpenGL once,
/// after linking.
template <class Permutation, class Functions>
[[nodiscard]] Locations<typename Permutation::Tables> find_locations(const Permutation& permutation,
                                                                     unsigned program, const Functions& gl) {
    Locations<typename Permutation::Tables> locations{};
    for (std::size_t row = 0; row < locations.numbers.size(); ++row) {
        const runtime::UniformLocation& uniform = Permutation::Tables::uniforms[row];
        locations.numbers[row] = uniform.only.applies_to(permutation)
                                     ? gl.GetUniformLocation(program, std::string(uniform.name).c_str())
                                     : -1;
    }
    return locations;
}

namespace detail {

/// Passes `count` values of so many columns and rows to OpenGL.
template <int Columns, int Rows, class Number, class Functions>
void upload(int location, int count, const Number* numbers, const Functions& gl) {
    constexpr int shape = Columns * 10 + Rows;
    if constexpr (Columns > 1) {
        static_assert(std::is_same_v<Number, float>, "only matrices of float can be set");
        if constexpr (shape == 22) gl.UniformMatrix2fv(location, count, 0, numbers);
        if constexpr (shape == 33) gl.UniformMatrix3fv(location, count, 0, numbers);
        if constexpr (shape == 44) gl.UniformMatrix4fv(location, count, 0, numbers);
        if constexpr (shape == 23) gl.UniformMatrix2x3fv(location, count, 0, numbers);
        if constexpr (shape == 24) gl.UniformMatrix2x4fv(location, count, 0, numbers);
        if constexpr (shape == 32) gl.UniformMatrix3x2fv(location, count, 0, numbers);
        if constexpr (shape == 34) gl.UniformMatrix3x4fv(location, count, 0, numbers);
        if constexpr (shape == 42) gl.UniformMatrix4x2fv(location, count, 0, numbers);
        if constexpr (shape == 43) gl.UniformMatrix4x3fv(location, count, 0, numbers);
    } else if constexpr (std::is_same_v<Number, float>) {
        if constexpr (Rows == 1) gl.Uniform1fv(location, count, numbers);
        if constexpr (Rows == 2) gl.Uniform2fv(location, count, numbers);
        if constexpr (Rows == 3) gl.Uniform3fv(location, count, numbers);
        if constexpr (Rows == 4) gl.Uniform4fv(location, count, numbers);
    } else if constexpr (std::is_same_v<Number, std::int32_t>) {
        if constexpr (Rows == 1) gl.Uniform1iv(location, count, numbers);
        if constexpr (Rows == 2) gl.Uniform2iv(location, count, numbers);
        if constexpr (Rows == 3) gl.Uniform3iv(location, count, numbers);
        if constexpr (Rows == 4) gl.Uniform4iv(location, count, numbers);
    } else {
        static_assert(std::is_same_v<Number, std::uint32_t>, "set uniforms of double by glUniform*dv");
        if constexpr (Rows == 1) gl.Uniform1uiv(location, count, numbers);
        if constexpr (Rows == 2) gl.Uniform2uiv(location, count, numbers);
        if constexpr (Rows == 3) gl.Uniform3uiv(location, count, numbers);
        if constexpr (Rows == 4) gl.Uniform4uiv(location, count, numbers);
    }
}

/// Sets `Count` elements from the first on. Nothing where the program does not have the uniform.
template <int Count, class Tables, class Value, int Extent, class Given, class Functions>
void set_values(const Locations<Tables>& locations, UniformPlace<Tables, Value, Extent> uniform,
                const Given* values, const Functions& gl) {
    static_assert(runtime::TakesValue<Value, Given>::value, "the uniform is of another type");
    static_assert(Count <= Extent, "the uniform's array is shorter");
    using Numbers = runtime::NumbersOf<Given>;
    const int location = locations.numbers[static_cast<std::size_t>(uniform.row)];
    if (location < 0) return;
    constexpr int size = Numbers::columns * Numbers::rows;
    typename Numbers::Number numbers[static_cast<std::size_t>(Count * size)];
    for (int index = 0; index < Count; ++index) Numbers::copy(values[index], numbers + index * size);
    upload<Numbers::columns, Numbers::rows>(location, Count, numbers, gl);
}

}  // namespace detail

/// Sets a uniform of the current program; nothing where the program does not have it. The value's type, and
/// for an array how many elements there are, are checked when compiling.
template <class Tables, class Value, int Extent, class Given, class Functions>
void set(const Locations<Tables>& locations, UniformPlace<Tables, Value, Extent> uniform, const Given& value,
         const Functions& gl) {
    detail::set_values<1>(locations, uniform, &value, gl);
}
template <class Tables, class Value, int Extent, class Given, std::size_t Count, class Functions>
void set(const Locations<Tables>& locations, UniformPlace<Tables, Value, Extent> uniform,
         const Given (&values)[Count], const Functions& gl) {
    detail::set_values<static_cast<int>(Count)>(locations, uniform, values, gl);
}
template <class Tables, class Value, int Extent, class Given, std::size_t Count, class Functions>
void set(const Locations<Tables>& locations, UniformPlace<Tables, Value, Extent> uniform,
         const std::array<Given, Count>& values, const Functions& gl) {
    detail::set_values<static_cast<int>(Count)>(locations, uniform, values.data(), gl);
}

#ifndef GOBO_GL_NO_LOADER
/// The same through the functions of the loader that was included.
template <class Permutation>
[[nodiscard]] Locations<typename Permutation::Tables> find_locations(const Permutation& permutation,
                                                                     unsigned program) {
    return find_locations(permutation, program, LoadedUniformFunctions{});
}
template <class Tables, class Value, int Extent, class Given>
void set(const Locations<Tables>& locations, UniformPlace<Tables, Value, Extent> uniform,
         const Given& values) {
    set(locations, uniform, values, LoadedUniformFunctions{});
}
#endif

}  // namespace gobo::gl
