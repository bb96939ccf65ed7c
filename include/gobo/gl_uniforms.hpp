// Sets uniforms outside blocks and binds textures by the typed places of a generated header, through whatever
// loader the application uses.
//
//     gobo::gl::Program program = gobo::gl::build_program(*p);
//     const auto locations = gobo::gl::find_locations(*p, program.id);       // once
//     glUseProgram(program.id);
//     gobo::gl::set(locations, game::uniform::tint, glm::vec3(1, 0, 0));     // another type does not compile
//     gobo::gl::set(locations, game::uniform::lights[2].radius, 5.0F);
//     gobo::gl::bind_texture(game::sampler::albedo, texture);                // to its unit, as its kind
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

namespace constant {
inline constexpr unsigned texture0 = 0x84C0;
}

#ifndef GOBO_GL_NO_LOADER
/// The functions of the loader that set uniforms and bind textures.
struct LoadedUniformFunctions : LoadedFunctions {
#define GOBO_GL_FUNCTION(name)                \
    template <class... Arguments>             \
    void name(Arguments... arguments) const { \
        gl##name(arguments...);               \
    }
    GOBO_GL_FUNCTION(ActiveTexture)
    GOBO_GL_FUNCTION(BindTexture)
    GOBO_GL_FUNCTION(Uniform1fv)
    GOBO_GL_FUNCTION(Uniform2fv)
    GOBO_GL_FUNCTION(Uniform3fv)
    GOBO_GL_FUNCTION(Uniform4fv)
    GOBO_GL_FUNCTION(Uniform2iv)
    GOBO_GL_FUNCTION(Uniform3iv)
    GOBO_GL_FUNCTION(Uniform4iv)
    GOBO_GL_FUNCTION(Uniform1uiv)
    GOBO_GL_FUNCTION(Uniform2uiv)
    GOBO_GL_FUNCTION(Uniform3uiv)
    GOBO_GL_FUNCTION(Uniform4uiv)
    GOBO_GL_FUNCTION(UniformMatrix2fv)
    GOBO_GL_FUNCTION(UniformMatrix3fv)
    GOBO_GL_FUNCTION(UniformMatrix4fv)
    GOBO_GL_FUNCTION(UniformMatrix2x3fv)
    GOBO_GL_FUNCTION(UniformMatrix2x4fv)
    GOBO_GL_FUNCTION(UniformMatrix3x2fv)
    GOBO_GL_FUNCTION(UniformMatrix3x4fv)
    GOBO_GL_FUNCTION(UniformMatrix4x2fv)
    GOBO_GL_FUNCTION(UniformMatrix4x3fv)
#undef GOBO_GL_FUNCTION
};
#endif

namespace detail {

/// The location of each row of a table: -1 where the program does not have the name or `is_declared(row)` is
/// not so.
template <std::size_t Count, class Row, class IsDeclared, class Functions>
[[nodiscard]] std::array<int, Count> locations_of(const std::array<Row, Count>& rows, unsigned program,
                                                  const Functions& gl, IsDeclared is_declared) {
    std::array<int, Count> locations{};
    for (std::size_t row = 0; row < Count; ++row)
        locations[row] =
            is_declared(rows[row]) ? gl.GetUniformLocation(program, std::string(rows[row].name).c_str()) : -1;
    return locations;
}

}  // namespace detail

/// Where the program, built from the permutation, has each uniform outside blocks and each sampler: asked of
/// OpenGL once, after linking.
template <class Permutation, class Functions>
[[nodiscard]] Locations<typename Permutation::Tables> find_locations(const Permutation& permutation,
                                                                     unsigned program, const Functions& gl) {
    using Tables = typename Permutation::Tables;
    const auto is_declared = [&permutation](const runtime::UniformLocation& uniform) {
        return uniform.only.applies_to(permutation);
    };
    // The declarations of a sampler share its place: any program has the name at most once.
    const auto is_any = [](const runtime::SamplerBinding&) { return true; };
    return {detail::locations_of(Tables::uniforms, program, gl, is_declared),
            detail::locations_of(Tables::samplers, program, gl, is_any)};
}

namespace detail {

/// Passes `count` values of so many columns and rows to OpenGL.
template <int Columns, int Rows, class Number, class Functions>
void upload(int location, int count, const Number* numbers, const Functions& gl) {
    constexpr int shape = Columns * 10 + Rows;
    [[maybe_unused]] constexpr unsigned char as_it_is = 0;  // not transposed
    if constexpr (Columns > 1) {
        static_assert(std::is_same_v<Number, float>, "only matrices of float can be set");
        if constexpr (shape == 22) gl.UniformMatrix2fv(location, count, as_it_is, numbers);
        if constexpr (shape == 33) gl.UniformMatrix3fv(location, count, as_it_is, numbers);
        if constexpr (shape == 44) gl.UniformMatrix4fv(location, count, as_it_is, numbers);
        if constexpr (shape == 23) gl.UniformMatrix2x3fv(location, count, as_it_is, numbers);
        if constexpr (shape == 24) gl.UniformMatrix2x4fv(location, count, as_it_is, numbers);
        if constexpr (shape == 32) gl.UniformMatrix3x2fv(location, count, as_it_is, numbers);
        if constexpr (shape == 34) gl.UniformMatrix3x4fv(location, count, as_it_is, numbers);
        if constexpr (shape == 42) gl.UniformMatrix4x2fv(location, count, as_it_is, numbers);
        if constexpr (shape == 43) gl.UniformMatrix4x3fv(location, count, as_it_is, numbers);
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

/// Gives a sampler of the current program another texture unit than the header does; nothing where the
/// program does not have it. An array takes as many units as it has elements, or fewer.
template <class Tables, unsigned Target, int Extent, std::size_t Count, class Functions>
void set(const Locations<Tables>& locations, SamplerPlace<Tables, Target, Extent> sampler,
         const std::array<int, Count>& units, const Functions& gl) {
    static_assert(Count <= static_cast<std::size_t>(Extent), "the array of samplers is shorter");
    const int location = locations.samplers[static_cast<std::size_t>(sampler.row)];
    if (location >= 0) gl.Uniform1iv(location, static_cast<int>(Count), units.data());
}
template <class Tables, unsigned Target, class Functions>
void set(const Locations<Tables>& locations, SamplerPlace<Tables, Target, 1> sampler, int unit,
         const Functions& gl) {
    set(locations, sampler, std::array<int, 1>{unit}, gl);
}

/// Binds textures of the sampler's kind to the units that build_program() gave it: one for each element of an
/// array, or fewer. Leaves the last of these units the active one.
template <class Tables, unsigned Target, int Extent, std::size_t Count, class Functions>
void bind_textures(SamplerPlace<Tables, Target, Extent> sampler, const std::array<unsigned, Count>& textures,
                   const Functions& gl) {
    static_assert(Target != 0, "no texture can be bound to it");
    static_assert(Count <= static_cast<std::size_t>(Extent), "the array of samplers is shorter");
    auto unit = constant::texture0 + static_cast<unsigned>(sampler.unit);
    for (const unsigned texture : textures) {
        gl.ActiveTexture(unit++);
        gl.BindTexture(Target, texture);
    }
}
template <class Tables, unsigned Target, class Functions>
void bind_texture(SamplerPlace<Tables, Target, 1> sampler, unsigned texture, const Functions& gl) {
    bind_textures(sampler, std::array<unsigned, 1>{texture}, gl);
}

#ifndef GOBO_GL_NO_LOADER
/// The same through the functions of the loader that was included.
template <class Permutation>
[[nodiscard]] Locations<typename Permutation::Tables> find_locations(const Permutation& permutation,
                                                                     unsigned program) {
    return find_locations(permutation, program, LoadedUniformFunctions{});
}
template <class Tables, class Place, class Given>
void set(const Locations<Tables>& locations, Place place, const Given& values) {
    set(locations, place, values, LoadedUniformFunctions{});
}
template <class Place>
void bind_texture(Place sampler, unsigned texture) {
    bind_texture(sampler, texture, LoadedUniformFunctions{});
}
template <class Place, std::size_t Count>
void bind_textures(Place sampler, const std::array<unsigned, Count>& textures) {
    bind_textures(sampler, textures, LoadedUniformFunctions{});
}
#endif

}  // namespace gobo::gl
