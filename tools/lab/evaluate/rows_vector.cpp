// Functions of vectors and matrices, and differences between the pixels of a quad. Formulas are those of the
// GLSL specification, 8.5 and 8.6. Matrices lie column by column.
#include <algorithm>
#include <array>
#include <cmath>

#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

// How a function adds up the products it consists of.
struct AsWritten {
    static constexpr bool kBackwards = false;
    template <class T>
    static T add_product(T sum, T a, T b) {
        return sum + a * b;
    }
};
struct Fused {
    static constexpr bool kBackwards = false;
    template <class T>
    static T add_product(T sum, T a, T b) {
        return std::fma(a, b, sum);
    }
};
struct Backwards : AsWritten {
    static constexpr bool kBackwards = true;
};

template <auto F, class Sum>
constexpr Execution kSumming =
    kRun<[](const Operation& operation, auto& registers) { F(Sum(), operation, registers); }>;

/// The row of a function that adds up products: its first parameter says how.
template <auto F>
constexpr Row summing(std::uint32_t code, std::string_view name, Kind kind, std::string_view signature,
                      double (*largest_error)(double, double, double) = nullptr) {
    return {
        code,
        name,
        kind,
        signature,
        kSumming<F, AsWritten>,
        {.fused = kSumming<F, Fused>, .backwards = kSumming<F, Backwards>, .largest_error = largest_error}};
}

// By Vulkan 1.3, Precision of Individual Operations: length() and distance() as sqrt(dot(x, x)), normalize()
// as x / length(x).
double error_of_length(double /*x*/, double /*y*/, double result) {
    return result > 0 ? 4.5 * ulp(result) : 0;
}
double error_of_direction(double /*x*/, double /*y*/, double result) {
    return result == 0 ? 0 : 7 * ulp(result);
}

/// One number of each lane.
template <class T>
using Lanes = std::array<T, kLanes>;

/// result = sum over k of a[k] * b[k], where a's rows are `stride_a` apart and b's follow one another.
template <class Sum, class T>
void sum_of_products(Registers<T>& registers, T* __restrict result, std::uint32_t a, std::uint32_t stride_a,
                     std::uint32_t b, std::uint32_t terms) {
    for (std::uint32_t at = 0; at < terms; ++at) {
        const std::uint32_t term = Sum::kBackwards ? terms - 1 - at : at;
        const T* row_a = registers.floats(a + term * stride_a);
        const T* row_b = registers.floats(b + term);
        // The first product alone: 0 + x would lose the sign of a negative 0.
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = at == 0 ? row_a[lane] * row_b[lane]
                                   : Sum::add_product(result[lane], row_a[lane], row_b[lane]);
    }
}

template <class Sum, class T>
Lanes<T> dot(Registers<T>& registers, std::uint32_t a, std::uint32_t b, std::uint32_t count) {
    Lanes<T> sum{};
    sum_of_products<Sum>(registers, sum.data(), a, 1, b, count);
    return sum;
}

template <class T>
void put_roots(const Lanes<T>& squares, T* result) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = std::sqrt(squares[lane]);
}

constexpr auto kDot = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    sum_of_products<Sum>(registers, registers.floats(operation.result), operation.operands[0], 1,
                         operation.operands[1], operation.count);
};

constexpr auto kLength = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    put_roots(dot<Sum>(registers, operation.operands[0], operation.operands[0], operation.count),
              registers.floats(operation.result));
};

constexpr auto kDistance = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    Lanes<T> squares{};
    for_each_component<Floats>(operation, registers, [&](T* /*result*/, const T* a, const T* b) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const T difference = a[lane] - b[lane];
            squares[lane] = Sum::add_product(squares[lane], difference, difference);
        }
    });
    put_roots(squares, registers.floats(operation.result));
};

constexpr auto kNormalize = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    Lanes<T> lengths = dot<Sum>(registers, operation.operands[0], operation.operands[0], operation.count);
    for (T& one : lengths) one = std::sqrt(one);
    for_each_component<Floats>(operation, registers,
                               [&](T* __restrict result, const T* a, const T* /*second*/) {
                                   for (std::size_t lane = 0; lane < kLanes; ++lane)
                                       result[lane] = a[lane] / lengths[lane];
                               });
};

constexpr auto kCross = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    for (std::uint32_t component = 0; component < 3; ++component) {
        const std::uint32_t next = (component + 1) % 3;
        const std::uint32_t last = (component + 2) % 3;
        T* __restrict result = registers.floats(operation.result + component);
        const T* a_next = registers.floats(operation.operands[0] + next);
        const T* a_last = registers.floats(operation.operands[0] + last);
        const T* b_next = registers.floats(operation.operands[1] + next);
        const T* b_last = registers.floats(operation.operands[1] + last);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = Sum::add_product(-(b_next[lane] * a_last[lane]), a_next[lane], b_last[lane]);
    }
};

/// N where dot(Nref, I) < 0, otherwise -N. Operands: N, I, Nref.
constexpr auto kFaceForward = []<class Sum, class T>(Sum, const Operation& operation,
                                                     Registers<T>& registers) {
    const auto facing = dot<Sum>(registers, operation.operands[2], operation.operands[1], operation.count);
    for_each_component<Floats>(operation, registers,
                               [&](T* __restrict result, const T* normal, const T* /*second*/) {
                                   for (std::size_t lane = 0; lane < kLanes; ++lane)
                                       result[lane] = facing[lane] < 0 ? normal[lane] : -normal[lane];
                               });
};

/// I - 2 dot(N, I) N. Operands: I, N.
constexpr auto kReflect = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    const auto along = dot<Sum>(registers, operation.operands[1], operation.operands[0], operation.count);
    for_each_component<Floats>(
        operation, registers, [&](T* __restrict result, const T* incident, const T* normal) {
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                result[lane] = Sum::add_product(incident[lane], T(-2) * along[lane], normal[lane]);
        });
};

/// k = 1 - eta^2 (1 - dot(N, I)^2); 0 where k < 0, otherwise eta I - (eta dot(N, I) + sqrt(k)) N.
constexpr auto kRefract = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    const auto along = dot<Sum>(registers, operation.operands[1], operation.operands[0], operation.count);
    const T* eta = registers.floats(operation.operands[2]);
    for_each_component<Floats>(
        operation, registers, [&](T* __restrict result, const T* incident, const T* normal) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const T k = T(1) - eta[lane] * eta[lane] * (T(1) - along[lane] * along[lane]);
                const T bent =
                    eta[lane] * incident[lane] - (eta[lane] * along[lane] + std::sqrt(k)) * normal[lane];
                result[lane] = k < 0 ? T(0) : bent;
            }
        });
};

// Words of the products: columns and rows of the result, terms of each sum.
constexpr auto kProduct = []<class Sum, class T>(Sum, const Operation& operation, Registers<T>& registers) {
    const std::uint32_t* words = registers.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        for (std::uint32_t row = 0; row < words[1]; ++row)
            sum_of_products<Sum>(registers, registers.floats(operation.result + column * words[1] + row),
                                 operation.operands[0] + row, words[1],
                                 operation.operands[1] + column * words[2], words[2]);
};

constexpr auto kTranspose = [](const Operation& operation, auto& registers) {
    const std::uint32_t* words = registers.words(operation);
    for (std::uint32_t column = 0; column < words[0]; ++column)
        for (std::uint32_t row = 0; row < words[1]; ++row)
            std::copy_n(registers.floats(operation.operands[0] + row * words[0] + column), kLanes,
                        registers.floats(operation.result + column * words[1] + row));
};

/// A square matrix of one lane, up to 4 x 4.
template <class T>
struct Square {
    Square(const Operation& operation, Registers<T>& registers, std::size_t lane)
        : size(registers.words(operation)[2]) {
        for (std::uint32_t column = 0; column < size; ++column)
            for (std::uint32_t row = 0; row < size; ++row)
                columns[column][row] = registers.floats(operation.operands[0] + column * size + row)[lane];
    }

    [[nodiscard]] T cofactor(std::uint32_t column, std::uint32_t row) const {
        Square minor = *this;
        --minor.size;
        for (std::uint32_t c = 0; c < minor.size; ++c)
            for (std::uint32_t r = 0; r < minor.size; ++r)
                minor.columns[c][r] = columns[c < column ? c : c + 1][r < row ? r : r + 1];
        return (column + row) % 2 == 0 ? minor.determinant() : -minor.determinant();
    }
    /// By Laplace's expansion along the first column.
    [[nodiscard]] T determinant() const {
        if (size == 1) return columns[0][0];
        T sum = columns[0][0] * cofactor(0, 0);
        for (std::uint32_t row = 1; row < size; ++row) sum += columns[0][row] * cofactor(0, row);
        return sum;
    }

    std::uint32_t size;
    std::array<std::array<T, 4>, 4> columns{};
};

constexpr auto kDeterminant = []<class T>(const Operation& operation, Registers<T>& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        registers.floats(operation.result)[lane] = Square<T>(operation, registers, lane).determinant();
};

/// The adjugate divided by the determinant (Cramer's rule).
constexpr auto kInverse = []<class T>(const Operation& operation, Registers<T>& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Square<T> matrix(operation, registers, lane);
        const T scale = matrix.determinant();
        for (std::uint32_t column = 0; column < matrix.size; ++column)
            for (std::uint32_t row = 0; row < matrix.size; ++row)
                registers.floats(operation.result + column * matrix.size + row)[lane] =
                    matrix.cofactor(row, column) / scale;
    }
};

// Lanes 4k to 4k+3 are the pixels (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).

/// The change to the right in the lane's line of its quad.
constexpr auto kAlongX = [](const auto* row, std::size_t lane) {
    const std::size_t left = lane & ~std::size_t{1};
    return row[left + 1] - row[left];
};
/// The change in +y in the lane's column of its quad.
constexpr auto kAlongY = [](const auto* row, std::size_t lane) {
    const std::size_t first = lane & ~std::size_t{2};
    return row[first + 2] - row[first];
};
constexpr auto kWidth = [](const auto* row, std::size_t lane) {
    return std::fabs(kAlongX(row, lane)) + std::fabs(kAlongY(row, lane));
};

/// Fine: each line or column of the quad has its own difference. Coarse: the quad has one.
template <auto Difference, bool kFine = true>
constexpr Execution kDerivative = kRun<[]<class T>(const Operation& operation, Registers<T>& registers) {
    for_each_component<Floats>(operation, registers,
                               [&](T* __restrict result, const T* value, const T* /*second*/) {
                                   for (std::size_t lane = 0; lane < kLanes; ++lane)
                                       result[lane] = Difference(value, kFine ? lane : lane - lane % 4);
                               });
}>;

/// An input at an offset from the pixel's centre: continued linearly. Operands: the input, the offset.
constexpr auto kAtOffset = []<class T>(const Operation& operation, Registers<T>& registers) {
    const T* offset_x = registers.floats(operation.operands[1]);
    const T* offset_y = registers.floats(operation.operands[1] + 1);
    for_each_component<Floats>(operation, registers,
                               [&](T* __restrict result, const T* value, const T* /*second*/) {
                                   for (std::size_t lane = 0; lane < kLanes; ++lane)
                                       result[lane] = value[lane] + kAlongX(value, lane) * offset_x[lane] +
                                                      kAlongY(value, lane) * offset_y[lane];
                               });
};

/// One sample at the centre of each pixel: centroid and sample are that centre.
constexpr Execution kAtCenter = kFloats<[](auto x) { return x; }>;

constexpr Row kRows[] = {
    summing<kDot>(GOBO_CORE(Dot), Kind::dot, "F:ff"),
    summing<kProduct>(GOBO_CORE(MatrixTimesVector), Kind::mul, ""),
    summing<kProduct>(GOBO_CORE(VectorTimesMatrix), Kind::mul, ""),
    summing<kProduct>(GOBO_CORE(MatrixTimesMatrix), Kind::mul, ""),
    summing<kProduct>(GOBO_CORE(OuterProduct), Kind::mul, ""),
    {GOBO_CORE(Transpose), Kind::matrix, "", kRun<kTranspose>},
    {GOBO_EXTENDED(Determinant), Kind::matrix, "", kRun<kDeterminant>},
    {GOBO_EXTENDED(MatrixInverse), Kind::matrix, "", kRun<kInverse>},
    summing<kLength>(GOBO_EXTENDED(Length), Kind::geometric, "F:f", error_of_length),
    summing<kDistance>(GOBO_EXTENDED(Distance), Kind::geometric, "F:ff", error_of_length),
    summing<kCross>(GOBO_EXTENDED(Cross), Kind::geometric, "f:ff3"),
    summing<kNormalize>(GOBO_EXTENDED(Normalize), Kind::geometric, "f:f", error_of_direction),
    summing<kFaceForward>(GOBO_EXTENDED(FaceForward), Kind::geometric, "f:fff"),
    summing<kReflect>(GOBO_EXTENDED(Reflect), Kind::geometric, "f:ff"),
    summing<kRefract>(GOBO_EXTENDED(Refract), Kind::geometric, "f:ffF"),
    {GOBO_CORE(DPdx), Kind::derivative, "f:f", kDerivative<kAlongX>},
    {GOBO_CORE(DPdy), Kind::derivative, "f:f", kDerivative<kAlongY>},
    {GOBO_CORE(Fwidth), Kind::derivative, "f:f", kDerivative<kWidth>},
    {GOBO_CORE(DPdxFine), Kind::derivative, "f:f", kDerivative<kAlongX>},
    {GOBO_CORE(DPdyFine), Kind::derivative, "f:f", kDerivative<kAlongY>},
    {GOBO_CORE(FwidthFine), Kind::derivative, "f:f", kDerivative<kWidth>},
    {GOBO_CORE(DPdxCoarse), Kind::derivative, "f:f", kDerivative<kAlongX, false>},
    {GOBO_CORE(DPdyCoarse), Kind::derivative, "f:f", kDerivative<kAlongY, false>},
    {GOBO_CORE(FwidthCoarse), Kind::derivative, "f:f", kDerivative<kWidth, false>},
    {GOBO_EXTENDED(InterpolateAtCentroid), Kind::derivative, "", kAtCenter},
    {GOBO_EXTENDED(InterpolateAtSample), Kind::derivative, "", kAtCenter},
    {GOBO_EXTENDED(InterpolateAtOffset), Kind::derivative, "", kRun<kAtOffset>},
};

}  // namespace

constinit const std::span<const Row> kVectorRows = kRows;

}  // namespace gobo::evaluate
