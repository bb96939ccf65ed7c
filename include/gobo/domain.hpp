// Values of a uniform block that lie outside the ranges its shaders are made for, as a generated header's
// check() finds them. No OpenGL.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <gobo/std140.hpp>

namespace gobo {

/// A number outside its range, or one that breaks a constraint.
struct OutOfRange {
    std::string member;   ///< "PointLights.lights[2].attenuation.y"; without the component where the range is
                          ///< of a vector's length; "determinant of Object.model"
    double value;         ///< of the component, the length, or what else `allowed` names; may be NaN
    std::string allowed;  ///< "[1e-06, 1000], or 0", "< Fog.end", "a length of 1"
    bool is_single = false;  ///< the member is of single precision
};

namespace runtime {

/// The shortest text that reads back as the number: as a float where that is what it is.
inline std::string number_text(double number, bool is_single) {
    if (std::isnan(number)) return "nan";  // a NaN's sign means nothing
    const auto single = static_cast<float>(number);
    const bool is_float = is_single && static_cast<double>(single) == number;
    const int most = is_float ? 9 : 17;
    // Whole numbers are written out, not as 1e+06.
    int digits = is_float ? std::trunc(number) == number && std::abs(number) < 1e9 ? most : 6 : 15;
    char text[32];
    for (;; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, number);
        const bool is_read_back =
            is_float ? std::strtof(text, nullptr) == single : std::strtod(text, nullptr) == number;
        if (is_read_back || digits >= most) return text;
    }
}

}  // namespace runtime

/// "PointLights.lights[2].attenuation.y is -1, allowed is [1e-06, 1000], or 0".
[[nodiscard]] inline std::string to_text(const OutOfRange& found) {
    return found.member + " is " + runtime::number_text(found.value, found.is_single) + ", allowed is " +
           found.allowed;
}

namespace runtime {

/// The range of one member: each component, or the length where `of_length`, lies within [low, high] or is
/// one of `also`.
struct Range {
    double low;
    double high;
    bool of_length;
    std::initializer_list<double> also;
    std::string_view text;
};

/// The components of a member, whatever its type.
struct Components {
    double values[16];
    int count = 0;
    int rows = 0;            ///< of a matrix, whose columns follow one another; otherwise 0
    bool are_single = true;  ///< of single precision, so that bounds are rounded to that before comparing

    void add(float value) { values[count++] = static_cast<double>(value); }
    template <class Number, std::enable_if_t<std::is_integral_v<Number>, int> = 0>
    void add(Number value) {
        add_wide(static_cast<double>(value));
    }
    void add(double value) { add_wide(value); }
    void add(const std140::Bool32& value) { add_wide(value ? 1.0 : 0.0); }
    template <int Length>
    void add(const std140::BoolVector<Length>& vector) {
        for (int i = 0; i < Length; ++i) add(vector[i]);
    }
    template <int Length, class Number>
    void add(const std140::Vector<Length, Number>& vector) {
        for (int i = 0; i < Length; ++i) add(vector[i]);
    }
    template <int Columns, int Rows, class Number>
    void add(const std140::PlainMatrix<Columns, Rows, Number>& matrix) {
        rows = Rows;
        for (int column = 0; column < Columns; ++column)
            for (int row = 0; row < Rows; ++row) add(matrix[column][row]);
    }
    template <int Columns, int Rows, class Number, std::size_t Stride>
    void add(const std140::Matrix<Columns, Rows, Number, Stride>& matrix) {
        add(static_cast<std140::PlainMatrix<Columns, Rows, Number>>(matrix));
    }
    template <int Columns, int Rows, class Number, std::size_t Stride>
    void add(const std140::RowMajorMatrix<Columns, Rows, Number, Stride>& matrix) {
        add(static_cast<std140::PlainMatrix<Columns, Rows, Number>>(matrix));
    }
    template <class Value, std::size_t Bytes>
    void add(const std140::Padded<Value, Bytes>& padded) {
        add(padded.value);
    }

  private:
    void add_wide(double value) {
        are_single = false;
        values[count++] = value;
    }
};

/// The path with the indices in its brackets.
inline std::string with_indices(std::string_view path, std::initializer_list<int> indices) {
    std::string text;
    const int* index = indices.begin();
    for (const char character : path) {
        if (character == ']' && index != indices.end()) text += std::to_string(*index++);
        text += character;
    }
    return text;
}

/// The name of one of the numbers of what has that name: "Fog.color.y", "Camera.projection[1].y".
inline std::string element_name(std::string name, int number, const Components& numbers) {
    if (numbers.rows > 0) {
        name += '[' + std::to_string(number / numbers.rows) + ']';
        number %= numbers.rows;
    }
    if (numbers.count > 1) name.append(1, '.').append(1, "xyzw"[number]);
    return name;
}

/// Written so that a NaN is within no range.
inline bool is_within(const Range& range, bool is_single, double number) {
    const auto as_held = [is_single](double bound) {
        return is_single ? static_cast<double>(static_cast<float>(bound)) : bound;
    };
    if (number >= as_held(range.low) && number <= as_held(range.high)) return true;
    for (const double value : range.also)
        if (number == as_held(value)) return true;
    return false;
}

/// Adds what of the member lies outside the range. Each `[]` of `path` stands for the next of `indices`.
inline void check_numbers(std::vector<OutOfRange>& found, std::string_view path,
                          std::initializer_list<int> indices, const Components& components,
                          const Range& range) {
    const std::string allowed(range.text);
    if (range.of_length) {
        double square = 0;
        for (int i = 0; i < components.count; ++i) square += components.values[i] * components.values[i];
        const double length = std::sqrt(square);
        if (!is_within(range, false, length))
            found.push_back({with_indices(path, indices), length, allowed, components.are_single});
        return;
    }
    for (int i = 0; i < components.count; ++i) {
        if (is_within(range, components.are_single, components.values[i])) continue;
        found.push_back({element_name(with_indices(path, indices), i, components), components.values[i],
                         allowed, components.are_single});
    }
}

template <class Member>
void check_member(std::vector<OutOfRange>& found, std::string_view path, std::initializer_list<int> indices,
                  const Member& member, const Range& range) {
    Components components;
    components.add(member);
    check_numbers(found, path, indices, components, range);
}

/// The same of one component of a vector, which the path names.
template <class Member>
void check_component(std::vector<OutOfRange>& found, std::string_view path,
                     std::initializer_list<int> indices, const Member& member, int component,
                     const Range& range) {
    Components all;
    all.add(member);
    Components one;
    one.are_single = all.are_single;
    one.values[one.count++] = all.values[component];
    check_numbers(found, path, indices, one, range);
}

}  // namespace runtime
}  // namespace gobo
