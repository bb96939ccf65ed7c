// Points vertex attributes at the members of an application's vertices, by the typed places of a generated
// header and through whatever loader the application uses.
//
//     glBindVertexArray(array);
//     glBindBuffer(GL_ARRAY_BUFFER, buffer);                                   // of struct Vertex
//     gobo::gl::point_to(game::attribute::position, &Vertex::position);        // another type does not
//     compile
//
// As in <gobo/gl.hpp>, a table of functions can be passed as a last argument.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <gobo/gl.hpp>
#include <gobo/uniform.hpp>

namespace gobo::gl {

namespace constant {
inline constexpr unsigned int_type = 0x1404;
inline constexpr unsigned unsigned_int_type = 0x1405;
inline constexpr unsigned float_type = 0x1406;
inline constexpr unsigned char not_normalized = 0;
}  // namespace constant

#ifndef GOBO_GL_NO_LOADER
/// The functions of the loader that describe vertices.
struct LoadedVertexFunctions {
    void EnableVertexAttribArray(unsigned location) const { glEnableVertexAttribArray(location); }
    void VertexAttribPointer(unsigned location, int size, unsigned type, unsigned char normalized, int stride,
                             const void* offset) const {
        glVertexAttribPointer(location, size, type, normalized, stride, offset);
    }
    void VertexAttribIPointer(unsigned location, int size, unsigned type, int stride,
                              const void* offset) const {
        glVertexAttribIPointer(location, size, type, stride, offset);
    }
};
#endif

namespace detail {

/// What a member of a vertex is to OpenGL; arrays of numbers are vectors, arrays of vectors matrices or
/// arrays.
template <class Member>
struct VertexMember : runtime::NumbersOf<Member> {
    using Value = Member;
    static constexpr int count = 1;
};
template <class Element, std::size_t Extent>
struct VertexMember<Element[Extent]> : runtime::NumbersOf<Element> {
    using Value = Element;
    static constexpr int count = static_cast<int>(Extent);
};

}  // namespace detail

/// Points an attribute at a member of vertices that stand in the buffer bound to GL_ARRAY_BUFFER,
/// `sizeof(Vertex)` bytes apart from `offset` on, and enables it. The member is of the attribute's type
/// (GLM's in any layout), of an array attribute an array of as many or fewer elements.
template <class Value, int Extent, class Vertex, class Member, class Functions>
void point_to(AttributePlace<Value, Extent> attribute, Member Vertex::*member, const Functions& gl,
              std::size_t offset = 0) {
    using Given = detail::VertexMember<Member>;
    static_assert(runtime::TakesValue<Value, typename Given::Value>::value,
                  "the attribute is of another type");
    static_assert(Given::count <= Extent, "the attribute's array is shorter");
    using Number = typename Given::Number;
    constexpr bool is_float = std::is_same_v<Number, float>;
    static_assert(is_float || std::is_same_v<Number, std::int32_t> || std::is_same_v<Number, std::uint32_t>,
                  "point at attributes of double by glVertexAttribLPointer");
    const Vertex vertex{};
    const auto* const begin = reinterpret_cast<const char*>(&vertex);
    offset += static_cast<std::size_t>(reinterpret_cast<const char*>(&(vertex.*member)) - begin);
    constexpr std::size_t column_size =
        sizeof(Member) / static_cast<std::size_t>(Given::count * Given::columns);  // with its padding
    constexpr unsigned type = is_float                   ? constant::float_type
                              : std::is_signed_v<Number> ? constant::int_type
                                                         : constant::unsigned_int_type;
    constexpr int stride = static_cast<int>(sizeof(Vertex));
    auto location = static_cast<unsigned>(attribute.location);
    for (int column = 0; column < Given::count * Given::columns;
         ++column, ++location, offset += column_size) {
        const void* const pointer = reinterpret_cast<const void*>(offset);
        gl.EnableVertexAttribArray(location);
        if constexpr (is_float)
            gl.VertexAttribPointer(location, Given::rows, type, constant::not_normalized, stride, pointer);
        else
            gl.VertexAttribIPointer(location, Given::rows, type, stride, pointer);
    }
}

#ifndef GOBO_GL_NO_LOADER
/// The same through the functions of the loader that was included.
template <class Value, int Extent, class Vertex, class Member>
void point_to(AttributePlace<Value, Extent> attribute, Member Vertex::*member) {
    point_to(attribute, member, LoadedVertexFunctions{});
}
#endif

}  // namespace gobo::gl
