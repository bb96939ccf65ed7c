// GLSL.std.450: functions of vectors. The formulas are those of the GLSL specification, 8.5.
#include <array>
#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// One number of each lane.
template <class T>
using Lanes = std::array<T, kLanes>;

template <class Sums, class T>
Lanes<T> dot(Machine<T>& machine, std::uint32_t a, std::uint32_t b, std::uint32_t count) {
    Lanes<T> sum{};
    for (std::uint32_t term = 0; term < count; ++term) {
        const std::uint32_t component = Sums::kBackwards ? count - 1 - term : term;
        const T* row_a = machine.reals(a + component);
        const T* row_b = machine.reals(b + component);
        // The first product alone: 0 + x would lose the sign of a negative 0.
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            sum[lane] = term == 0 ? row_a[lane] * row_b[lane]
                                  : Sums::add_product(sum[lane], row_a[lane], row_b[lane]);
    }
    return sum;
}

template <class Sums, class T>
void length(const Operation& operation, Machine<T>& machine) {
    const Lanes<T> squares =
        dot<Sums>(machine, operation.operands[0], operation.operands[0], operation.count);
    T* result = machine.reals(operation.result);
    for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = std::sqrt(squares[lane]);
}

template <class Sums, class T>
void distance(const Operation& operation, Machine<T>& machine) {
    Lanes<T> squares{};
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        const T* a = machine.reals(operation.operands[0] + component);
        const T* b = machine.reals(operation.operands[1] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const T difference = a[lane] - b[lane];
            squares[lane] = Sums::add_product(squares[lane], difference, difference);
        }
    }
    T* result = machine.reals(operation.result);
    for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = std::sqrt(squares[lane]);
}

template <class Sums, class T>
void normalize(const Operation& operation, Machine<T>& machine) {
    Lanes<T> lengths = dot<Sums>(machine, operation.operands[0], operation.operands[0], operation.count);
    for (T& one : lengths) one = std::sqrt(one);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* a = machine.reals(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = a[lane] / lengths[lane];
    }
}

template <class Sums, class T>
void cross(const Operation& operation, Machine<T>& machine) {
    for (std::uint32_t component = 0; component < 3; ++component) {
        const std::uint32_t next = (component + 1) % 3;
        const std::uint32_t last = (component + 2) % 3;
        T* __restrict result = machine.reals(operation.result + component);
        const T* a_next = machine.reals(operation.operands[0] + next);
        const T* a_last = machine.reals(operation.operands[0] + last);
        const T* b_next = machine.reals(operation.operands[1] + next);
        const T* b_last = machine.reals(operation.operands[1] + last);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = Sums::add_product(-(b_next[lane] * a_last[lane]), a_next[lane], b_last[lane]);
    }
}

/// N where dot(Nref, I) < 0, otherwise -N. Operands: N, I, Nref.
template <class Sums, class T>
void face_forward(const Operation& operation, Machine<T>& machine) {
    const Lanes<T> facing = dot<Sums>(machine, operation.operands[2], operation.operands[1], operation.count);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* normal = machine.reals(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = facing[lane] < 0 ? normal[lane] : -normal[lane];
    }
}

/// I - 2 dot(N, I) N. Operands: I, N.
template <class Sums, class T>
void reflect(const Operation& operation, Machine<T>& machine) {
    const Lanes<T> along = dot<Sums>(machine, operation.operands[1], operation.operands[0], operation.count);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* incident = machine.reals(operation.operands[0] + component);
        const T* normal = machine.reals(operation.operands[1] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = Sums::add_product(incident[lane], T(-2) * along[lane], normal[lane]);
    }
}

/// k = 1 - eta^2 (1 - dot(N, I)^2); 0 where k < 0, otherwise eta I - (eta dot(N, I) + sqrt(k)) N.
template <class Sums, class T>
void refract(const Operation& operation, Machine<T>& machine) {
    const Lanes<T> along = dot<Sums>(machine, operation.operands[1], operation.operands[0], operation.count);
    const T* eta = machine.reals(operation.operands[2]);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* incident = machine.reals(operation.operands[0] + component);
        const T* normal = machine.reals(operation.operands[1] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const T k = T(1) - eta[lane] * eta[lane] * (T(1) - along[lane] * along[lane]);
            const T bent =
                eta[lane] * incident[lane] - (eta[lane] * along[lane] + std::sqrt(k)) * normal[lane];
            result[lane] = k < 0 ? T(0) : bent;
        }
    }
}

#define GOBO_GEOMETRIC(name, signature, function)                                     \
    {                                                                                 \
        kExtended + GLSLstd450##name, #name, Kind::geometric, signature,              \
            {&function<AsWritten, float>, &function<AsWritten, double>}, {            \
            .fused = {&function<Fused, float>, &function<Fused, double>},             \
            .backwards = {&function<Backwards, float>, &function<Backwards, double>}, \
        }                                                                             \
    }

constexpr Row kRows[] = {
    GOBO_GEOMETRIC(Length, "F:f", length),
    GOBO_GEOMETRIC(Distance, "F:ff", distance),
    GOBO_GEOMETRIC(Cross, "f:ff3", cross),
    GOBO_GEOMETRIC(Normalize, "f:f", normalize),
    GOBO_GEOMETRIC(FaceForward, "f:fff", face_forward),
    GOBO_GEOMETRIC(Reflect, "f:ff", reflect),
    GOBO_GEOMETRIC(Refract, "f:ffF", refract),
};

#undef GOBO_GEOMETRIC

}  // namespace

std::span<const Row> geometric_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
