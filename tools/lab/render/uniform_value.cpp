#include "lab/render/uniform_value.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "lab/render/value_type.hpp"

namespace gobo {
namespace {

/// The nearest value of an integer type; NaN becomes 0.
template <class Integer>
Integer to_integer(double number) {
    constexpr double low = std::numeric_limits<Integer>::min();
    constexpr double high = std::numeric_limits<Integer>::max();
    return std::isnan(number) ? Integer{0} : static_cast<Integer>(std::clamp(std::round(number), low, high));
}

template <class Value>
void put(std::vector<std::byte>& bytes, int offset, Value value) {
    const auto first = static_cast<std::size_t>(offset);
    if (offset >= 0 && first + sizeof value <= bytes.size()) std::memcpy(&bytes[first], &value, sizeof value);
}

void put_component(std::vector<std::byte>& bytes, int offset, Component component, double number) {
    switch (component) {
        case Component::float32:
            return put(bytes, offset, static_cast<float>(number));
        case Component::float64:
            return put(bytes, offset, number);
        case Component::int32:
            return put(bytes, offset, to_integer<std::int32_t>(number));
        case Component::uint32:
            return put(bytes, offset, to_integer<std::uint32_t>(number));
        case Component::boolean:
            return put(bytes, offset, std::uint32_t{number != 0 ? 1U : 0U});
    }
}

/// From the start of an element to one of its components.
int component_offset(const Leaf& leaf, const ValueType& type, int index) {
    const int size = type.component == Component::float64 ? 8 : 4;
    const int column = index / type.rows;
    const int row = index % type.rows;
    if (!type.is_matrix()) return row * size;
    return leaf.row_major ? row * leaf.matrix_stride + column * size
                          : column * leaf.matrix_stride + row * size;
}

void set_float_matrix(const GladGLContext& gl, const ValueType& type, GLint location, GLsizei count,
                      const GLfloat* values) {
    switch (type.enumerant) {
        case GL_FLOAT_MAT2:
            return gl.UniformMatrix2fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT3:
            return gl.UniformMatrix3fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT4:
            return gl.UniformMatrix4fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT2x3:
            return gl.UniformMatrix2x3fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT2x4:
            return gl.UniformMatrix2x4fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT3x2:
            return gl.UniformMatrix3x2fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT3x4:
            return gl.UniformMatrix3x4fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT4x2:
            return gl.UniformMatrix4x2fv(location, count, GL_FALSE, values);
        case GL_FLOAT_MAT4x3:
            return gl.UniformMatrix4x3fv(location, count, GL_FALSE, values);
        default:
            return;  // check() has refused matrices of doubles
    }
}

/// The setters of vectors of 1 to 4 components, chosen by the count of rows.
template <class Value, class Setter>
void set_vector(const std::vector<double>& numbers, int rows, GLint location, Value (*convert)(double),
                const Setter (&setters)[4]) {
    std::vector<Value> values;
    for (const double number : numbers) values.push_back(convert(number));
    setters[rows - 1](location, static_cast<GLsizei>(values.size()) / rows, values.data());
}

}  // namespace

Result<void> check(const Assignment& assignment, const Place& place) {
    const Leaf& leaf = assignment.leaf;
    const auto type = value_type(leaf.type);
    Diagnostic diagnostic;
    diagnostic.place = place;
    if (!type || (leaf.block.empty() && type->component == Component::float64 && type->is_matrix())) {
        diagnostic.message =
            fmt::format("'{}' is of type {}, which the renderer cannot supply", leaf.name, leaf.type);
        return fail(std::move(diagnostic));
    }
    const std::size_t components = static_cast<std::size_t>(type->components());
    const std::size_t most = components * static_cast<std::size_t>(leaf.count);
    const std::size_t given = assignment.numbers.size();
    if (given > 0 && given <= most && given % components == 0) return {};
    diagnostic.message = fmt::format("'{}' is given {} number{}", leaf.name, given, given == 1 ? "" : "s");
    diagnostic.help = leaf.count > 1 ? fmt::format("it is an array of {}: give a multiple of {}, at most {}",
                                                   leaf.type, components, most)
                                     : fmt::format("it is of type {}: give {}", leaf.type, components);
    return fail(std::move(diagnostic));
}

void write(const Assignment& assignment, std::vector<std::byte>& block) {
    const auto type = value_type(assignment.leaf.type);
    if (!type) return;
    const int components = type->components();
    for (int i = 0; i < static_cast<int>(assignment.numbers.size()); ++i) {
        const int offset = assignment.leaf.offset + i / components * assignment.leaf.array_stride +
                           component_offset(assignment.leaf, *type, i % components);
        put_component(block, offset, type->component, assignment.numbers[static_cast<std::size_t>(i)]);
    }
}

void set_uniform(const GladGLContext& gl, const Program& program, const Assignment& assignment) {
    const auto type = value_type(assignment.leaf.type);
    const GLint location = gl.GetUniformLocation(program.id(), assignment.leaf.name.c_str());
    if (!type || location < 0) return;
    const std::vector<double>& numbers = assignment.numbers;
    if (type->is_matrix()) {
        const std::vector<GLfloat> values(numbers.begin(), numbers.end());
        set_float_matrix(gl, *type, location, static_cast<GLsizei>(values.size()) / type->components(),
                         values.data());
        return;
    }
    switch (type->component) {
        case Component::float32:
            return set_vector<GLfloat>(numbers, type->rows, location,
                                       +[](double number) { return static_cast<GLfloat>(number); },
                                       {gl.Uniform1fv, gl.Uniform2fv, gl.Uniform3fv, gl.Uniform4fv});
        case Component::float64:
            return set_vector<GLdouble>(numbers, type->rows, location, +[](double number) { return number; },
                                        {gl.Uniform1dv, gl.Uniform2dv, gl.Uniform3dv, gl.Uniform4dv});
        case Component::int32:
            return set_vector<GLint>(numbers, type->rows, location, to_integer<GLint>,
                                     {gl.Uniform1iv, gl.Uniform2iv, gl.Uniform3iv, gl.Uniform4iv});
        case Component::uint32:
            return set_vector<GLuint>(numbers, type->rows, location, to_integer<GLuint>,
                                      {gl.Uniform1uiv, gl.Uniform2uiv, gl.Uniform3uiv, gl.Uniform4uiv});
        case Component::boolean:
            return set_vector<GLint>(numbers, type->rows, location,
                                     +[](double number) { return GLint{number != 0 ? 1 : 0}; },
                                     {gl.Uniform1iv, gl.Uniform2iv, gl.Uniform3iv, gl.Uniform4iv});
    }
}

}  // namespace gobo
