// Whether values keep the constraints of a family, as a generated header's check() finds it. No OpenGL.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <gobo/domain.hpp>

namespace gobo {
namespace runtime {

/// How far a length may be from 1, and the dot product of two columns from 0.
inline constexpr double kUnitError = 1e-6;
/// How far a component may be from that of the exact inverse transpose, as a part of the largest. Computed in
/// single precision it is off by that at scales of some 1 : 100.
inline constexpr double kInverseError = 1e-4;

/// A value that a constraint names.
struct Operand {
    std::string name;  ///< "PointLights.lights[2].position"
    Components numbers;

    /// The length of some of its numbers.
    [[nodiscard]] double length(int first, int count) const { return std::sqrt(dot(first, first, count)); }
    [[nodiscard]] double dot(int first, int second, int count) const {
        double sum = 0;
        for (int i = 0; i < count; ++i) sum += numbers.values[first + i] * numbers.values[second + i];
        return sum;
    }
};

/// The columns of a square matrix of that many numbers.
inline int columns_of(int count) {
    return count == 4 ? 2 : count == 9 ? 3 : 4;
}

/// Each `[]` of `path` stands for the next of `indices`.
template <class Member>
Operand operand(std::string_view path, std::initializer_list<int> indices, const Member& member) {
    Operand result{with_indices(path, indices), {}};
    result.numbers.add(member);
    return result;
}
/// The same of one component of a vector, which the path names.
template <class Member>
Operand operand(std::string_view path, std::initializer_list<int> indices, const Member& member,
                int component) {
    Operand all = operand(path, indices, member);
    all.numbers.values[0] = all.numbers.values[component];
    all.numbers.count = 1;
    return all;
}
/// Adds what of `less` is not below `more` ("<"), not above it ("<=") or equal to it ("!="); a single number
/// is compared with each of a vector. A NaN is never in order.
inline void check_order(std::vector<OutOfRange>& found, const Operand& less, std::string_view sign,
                        const Operand& more) {
    const Components& lefts = less.numbers;
    const Components& rights = more.numbers;
    const int count = lefts.count == 1    ? rights.count
                      : rights.count == 1 ? lefts.count
                                          : (std::min)(lefts.count, rights.count);
    for (int i = 0; i < count; ++i) {
        const int at = lefts.count == 1 ? 0 : i;
        const double left = lefts.values[at];
        const double right = rights.values[rights.count == 1 ? 0 : i];
        if (sign == "<" ? left < right : sign == "<=" ? left <= right : left < right || left > right)
            continue;
        found.push_back({element_name(less.name, at, lefts), left, std::string(sign) + ' ' + more.name,
                         lefts.are_single});
    }
}

/// The same of a number that the constraint states, with ">" and ">=" too. Strictly it differs by 1e-6 at
/// least, and by a rounding or two: nearer the shaders were not searched.
inline void check_bound(std::vector<OutOfRange>& found, const Operand& member, std::string_view sign,
                        double bound) {
    const std::string allowed = std::string(sign) + ' ' + number_text(bound, member.numbers.are_single);
    double step = 0;
    if (member.numbers.are_single) {
        bound = static_cast<double>(static_cast<float>(bound));
        const double size = std::abs(bound);
        step =
            (std::max)(0.99999e-6, size * 0x1p-22) - size * 0x1p-23;  // less what the member's rounding takes
    }
    for (int i = 0; i < member.numbers.count; ++i) {
        const double value = member.numbers.values[i];
        const double within = sign[0] == '<' ? bound - value : value - bound;
        const bool is_kept = sign == "!="       ? within < 0 || within > 0
                             : sign.size() == 2 ? within >= 0
                                                : within > 0 && within >= step;
        if (is_kept) continue;
        found.push_back({element_name(member.name, i, member.numbers), value,
                         allowed + (within > 0 ? " by 1e-06" : ""), member.numbers.are_single});
    }
}

/// Adds the vector where its length is not 1.
inline void check_unit(std::vector<OutOfRange>& found, const Operand& vector) {
    const double length = vector.length(0, vector.numbers.count);
    if (!(std::abs(length - 1) <= kUnitError))
        found.push_back({vector.name, length, "a length of 1", vector.numbers.are_single});
}

/// Adds the vector where all of it is 0, or where it has no direction for a NaN or an infinity in it.
inline void check_not_zero(std::vector<OutOfRange>& found, const Operand& vector) {
    double largest = 0;
    for (int i = 0; i < vector.numbers.count && !std::isnan(largest); ++i)
        if (const double size = std::abs(vector.numbers.values[i]); !(size <= largest)) largest = size;
    if (largest > 0 && !std::isinf(largest)) return;
    found.push_back({vector.name, largest,
                     std::isinf(largest) ? "a finite length above 0" : "a length above 0",
                     vector.numbers.are_single});
}

/// Adds the first of two vectors that are equal as far as both go, or whose distance is a NaN.
inline void check_distinct(std::vector<OutOfRange>& found, const Operand& one, const Operand& other) {
    const int count = (std::min)(one.numbers.count, other.numbers.count);
    double largest = 0;
    for (int i = 0; i < count && !std::isnan(largest); ++i) {
        const double apart = std::abs(one.numbers.values[i] - other.numbers.values[i]);
        if (!(apart <= largest)) largest = apart;
    }
    if (largest > 0) return;
    found.push_back({one.name, largest, "a distance above 0 from " + other.name, one.numbers.are_single});
}

/// Adds the columns of the matrix whose length is not 1, and which are not perpendicular to an earlier one.
inline void check_orthonormal(std::vector<OutOfRange>& found, const Operand& matrix) {
    const int rows = columns_of(matrix.numbers.count);
    const auto column_name = [&](int column) { return matrix.name + '[' + std::to_string(column) + ']'; };
    for (int column = 0; column < rows; ++column) {
        const double length = matrix.length(column * rows, rows);
        if (!(std::abs(length - 1) <= kUnitError))
            found.push_back({column_name(column), length, "a length of 1", matrix.numbers.are_single});
        for (int before = 0; before < column; ++before) {
            const double dot = matrix.dot(column * rows, before * rows, rows);
            if (!(std::abs(dot) <= kUnitError))
                found.push_back({column_name(column), dot, "a dot product of 0 with " + column_name(before),
                                 matrix.numbers.are_single});
        }
    }
}

/// Adds the component that is furthest from the inverse transpose of the other's upper left 3 x 3; the other
/// where it has none.
inline void check_inverse_transpose(std::vector<OutOfRange>& found, const Operand& matrix,
                                    const Operand& of) {
    const int stride = columns_of(of.numbers.count);
    const auto at = [&](int column, int row) { return of.numbers.values[column % 3 * stride + row % 3]; };
    double cofactors[9];
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            cofactors[column * 3 + row] = at(column + 1, row + 1) * at(column + 2, row + 2) -
                                          at(column + 2, row + 1) * at(column + 1, row + 2);
            largest = (std::max)(largest, std::abs(at(column, row)));
        }
    double determinant = 0;
    for (int row = 0; row < 3; ++row) determinant += at(0, row) * cofactors[row];
    if (!(std::abs(determinant) > 1e-6 * largest * largest * largest)) {
        found.push_back({"determinant of " + of.name, determinant,
                         "a size above 1e-06 of the cube of the matrix's largest number",
                         of.numbers.are_single});
        return;
    }
    double size = 0;
    for (const double cofactor : cofactors) size = (std::max)(size, std::abs(cofactor / determinant));
    int worst = 0;
    double error = -1;
    for (int i = 0; i < 9; ++i) {
        const double own = std::abs(matrix.numbers.values[i] - cofactors[i] / determinant);
        if (own <= error) continue;
        worst = i;
        error = own;
        if (!(own <= error)) break;  // a NaN
    }
    if (error <= kInverseError * size) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", cofactors[worst] / determinant);
    found.push_back({element_name(matrix.name, worst, matrix.numbers), matrix.numbers.values[worst],
                     std::string(text) + " for the inverse transpose of " + of.name,
                     matrix.numbers.are_single});
}

}  // namespace runtime

/// Whether the vector is `unit()`, as check(block) understands it: for what stands in no block.
template <int Length, class Number, glm::qualifier Layout>
[[nodiscard]] bool is_unit(const glm::vec<Length, Number, Layout>& vector) {
    std::vector<OutOfRange> found;
    runtime::check_unit(found, runtime::operand("", {}, std140::Vector<Length, Number>(vector)));
    return found.empty();
}

/// Whether the matrix is `orthonormal()`.
template <int Columns, class Number, glm::qualifier Layout>
[[nodiscard]] bool is_orthonormal(const glm::mat<Columns, Columns, Number, Layout>& matrix) {
    std::vector<OutOfRange> found;
    runtime::check_orthonormal(
        found, runtime::operand("", {}, std140::PlainMatrix<Columns, Columns, Number>(matrix)));
    return found.empty();
}

/// Whether the matrix is `inverse_transpose_of()` the upper left 3 x 3 of the other.
template <int Columns, class Number, glm::qualifier Layout>
[[nodiscard]] bool is_inverse_transpose(const glm::mat<3, 3, Number, Layout>& matrix,
                                        const glm::mat<Columns, Columns, Number, Layout>& of) {
    std::vector<OutOfRange> found;
    runtime::check_inverse_transpose(
        found, runtime::operand("", {}, std140::PlainMatrix<3, 3, Number>(matrix)),
        runtime::operand("", {}, std140::PlainMatrix<Columns, Columns, Number>(of)));
    return found.empty();
}

}  // namespace gobo
