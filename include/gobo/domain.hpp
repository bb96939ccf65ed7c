// Values of a uniform block that lie outside the ranges its shaders are made for, as a generated header's
// check() finds them. No OpenGL.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <gobo/std140.hpp>

namespace gobo {

/// A number outside its range.
struct OutOfRange {
    std::string member;   ///< "PointLights.lights[2].attenuation.y"; without the component where the range is
                          ///< of a vector's length
    double value;         ///< of the component, or the length; may be NaN
    std::string allowed;  ///< "[1e-06, 1000], or 0", as the header's comments have it
};

/// "PointLights.lights[2].attenuation.y is -1, allowed is [1e-06, 1000], or 0".
[[nodiscard]] inline std::string to_text(const OutOfRange& found) {
    char number[32];
    std::snprintf(number, sizeof number, "%.9g", found.value);
    return found.member + " is " + number + ", allowed is " + found.allowed;
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
        if (!is_within(range, false, length)) found.push_back({with_indices(path, indices), length, allowed});
        return;
    }
    for (int i = 0; i < components.count; ++i) {
        if (is_within(range, components.are_single, components.values[i])) continue;
        std::string member = with_indices(path, indices);
        if (components.count > 1 && components.count <= 4) {
            member += '.';
            member += "xyzw"[i];
        } else if (components.count > 4) {
            member += '[' + std::to_string(i) + ']';
        }
        found.push_back({member, components.values[i], allowed});
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

/// Adds what of `less` is not below `more` ("<"), not above it ("<=") or equal to it ("!="); a single number
/// is compared with each of a vector. A NaN is never in order.
template <class Less, class More>
void check_order(std::vector<OutOfRange>& found, std::string_view path, std::initializer_list<int> indices,
                 const Less& less, const More& more, std::string_view sign, std::string_view other) {
    Components lefts;
    Components rights;
    lefts.add(less);
    rights.add(more);
    for (int i = 0; i < lefts.count && (i < rights.count || rights.count == 1); ++i) {
        const double left = lefts.values[i];
        const double right = rights.values[rights.count == 1 ? 0 : i];
        if (sign == "<" ? left < right : sign == "<=" ? left <= right : left < right || left > right)
            continue;
        std::string member = with_indices(path, indices);
        if (lefts.count > 1 && lefts.count <= 4) {
            member += '.';
            member += "xyzw"[i];
        }
        found.push_back({member, left, std::string(sign) + ' ' + with_indices(other, indices)});
    }
}

}  // namespace runtime
}  // namespace gobo
