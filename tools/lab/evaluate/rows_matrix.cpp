// Products of vectors and matrices. Matrices lie column by column; sums run from the first term to the last.
#include <algorithm>
#include <array>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// result = sum over k of a[k] * b[k], where a's rows are `stride_a` apart and b's `stride_b`.
template <class Sums, class T>
void sum_of_products(Machine<T>& machine, std::uint32_t result_slot, std::uint32_t a, std::uint32_t stride_a,
                     std::uint32_t b, std::uint32_t stride_b, std::uint32_t terms) {
    T* __restrict result = machine.reals(result_slot);
    for (std::uint32_t at = 0; at < terms; ++at) {
        const std::uint32_t term = Sums::kBackwards ? terms - 1 - at : at;
        const T* row_a = machine.reals(a + term * stride_a);
        const T* row_b = machine.reals(b + term * stride_b);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = at == 0 ? row_a[lane] * row_b[lane]
                                   : Sums::add_product(result[lane], row_a[lane], row_b[lane]);
    }
}

template <class Sums, class T>
void dot(const Operation& operation, Machine<T>& machine) {
    sum_of_products<Sums>(machine, operation.result, operation.operands[0], 1, operation.operands[1], 1,
                          operation.count);
}

// Words of the products: columns and rows of the result, terms of each sum.
template <class Sums, class T>
void matrix_times_matrix(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        for (std::uint32_t row = 0; row < words[1]; ++row)
            sum_of_products<Sums>(machine, operation.result + column * words[1] + row,
                                  operation.operands[0] + row, words[1],
                                  operation.operands[1] + column * words[2], 1, words[2]);
}

template <class Sums, class T>
void vector_times_matrix(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        sum_of_products<Sums>(machine, operation.result + column, operation.operands[0], 1,
                              operation.operands[1] + column * words[2], 1, words[2]);
}

template <class Sums, class T>
void outer_product(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        for (std::uint32_t row = 0; row < words[1]; ++row)
            sum_of_products<Sums>(machine, operation.result + column * words[1] + row,
                                  operation.operands[0] + row, 1, operation.operands[1] + column, 1, 1);
}

template <class T>
void transpose(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        for (std::uint32_t row = 0; row < words[1]; ++row)
            std::copy_n(machine.reals(operation.operands[0] + row * words[0] + column), kLanes,
                        machine.reals(operation.result + column * words[1] + row));
}

/// A square matrix of one lane, up to 4 x 4.
template <class T>
struct Square {
    std::uint32_t size = 0;
    std::array<std::array<T, 4>, 4> columns{};

    /// Without one column and one row.
    [[nodiscard]] Square without(std::uint32_t column, std::uint32_t row) const {
        Square smaller{size - 1, {}};
        for (std::uint32_t c = 0; c < smaller.size; ++c)
            for (std::uint32_t r = 0; r < smaller.size; ++r)
                smaller.columns[c][r] = columns[c < column ? c : c + 1][r < row ? r : r + 1];
        return smaller;
    }
    [[nodiscard]] T cofactor(std::uint32_t column, std::uint32_t row) const {
        const T minor = without(column, row).determinant();
        return (column + row) % 2 == 0 ? minor : -minor;
    }
    /// By Laplace's expansion along the first column.
    [[nodiscard]] T determinant() const {
        if (size == 1) return columns[0][0];
        T sum = columns[0][0] * cofactor(0, 0);
        for (std::uint32_t row = 1; row < size; ++row) sum += columns[0][row] * cofactor(0, row);
        return sum;
    }
};

template <class T>
Square<T> gather_square(const Operation& operation, Machine<T>& machine, std::size_t lane) {
    Square<T> matrix{machine.words(operation)[2], {}};
    for (std::uint32_t column = 0; column < matrix.size; ++column)
        for (std::uint32_t row = 0; row < matrix.size; ++row)
            matrix.columns[column][row] =
                machine.reals(operation.operands[0] + column * matrix.size + row)[lane];
    return matrix;
}

template <class T>
void determinant(const Operation& operation, Machine<T>& machine) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        machine.reals(operation.result)[lane] = gather_square(operation, machine, lane).determinant();
}

/// The adjugate divided by the determinant (Cramer's rule).
template <class T>
void inverse(const Operation& operation, Machine<T>& machine) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Square<T> matrix = gather_square(operation, machine, lane);
        const T scale = matrix.determinant();
        for (std::uint32_t column = 0; column < matrix.size; ++column)
            for (std::uint32_t row = 0; row < matrix.size; ++row)
                machine.reals(operation.result + column * matrix.size + row)[lane] =
                    matrix.cofactor(row, column) / scale;
    }
}

#define GOBO_SUM(name, kind, signature, function)                                                           \
    {                                                                                                       \
        spv::Op##name, #name, kind, signature, {&function<AsWritten, float>, &function<AsWritten, double>}, \
        {                                                                                                   \
            .fused = {&function<Fused, float>, &function<Fused, double>},                                   \
            .backwards = {&function<Backwards, float>, &function<Backwards, double>},                       \
        }                                                                                                   \
    }

constexpr Row kRows[] = {
    GOBO_SUM(Dot, Kind::dot, "F:ff", dot),
    GOBO_SUM(MatrixTimesVector, Kind::mul, "", matrix_times_matrix),
    GOBO_SUM(VectorTimesMatrix, Kind::mul, "", vector_times_matrix),
    GOBO_SUM(MatrixTimesMatrix, Kind::mul, "", matrix_times_matrix),
    GOBO_SUM(OuterProduct, Kind::mul, "", outer_product),
    {spv::OpTranspose, "Transpose", Kind::matrix, "", {&transpose<float>, &transpose<double>}},
    {kExtended + GLSLstd450Determinant,
     "Determinant",
     Kind::matrix,
     "",
     {&determinant<float>, &determinant<double>}},
    {kExtended + GLSLstd450MatrixInverse,
     "MatrixInverse",
     Kind::matrix,
     "",
     {&inverse<float>, &inverse<double>}},
};

#undef GOBO_SUM

}  // namespace

std::span<const Row> matrix_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
