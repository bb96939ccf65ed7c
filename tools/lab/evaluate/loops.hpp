// Makes rows' executions out of one-line functions of a component. Internal to evaluation.
#pragma once

#include <cmath>
#include <type_traits>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/machine.hpp"

namespace gobo::evaluate {

/// 32-bit views of what a row of whole numbers holds.
template <class W>
[[nodiscard]] inline std::int32_t to_signed(W cell) {
    return static_cast<std::int32_t>(cell);
}
template <class W>
[[nodiscard]] inline std::uint32_t to_unsigned(W cell) {
    return static_cast<std::uint32_t>(cell);
}

/// The rows of an operand or result: reals or whole numbers.
struct RealRows {
    template <class T>
    static T* of(Machine<T>& machine, std::uint32_t slot) {
        return machine.reals(slot);
    }
};
struct WholeRows {
    template <class T>
    static Whole<T>* of(Machine<T>& machine, std::uint32_t slot) {
        return machine.wholes(slot);
    }
};

/// Component by component, all lanes: the compiler turns these loops into vector instructions. Results never
/// overlap operands: the decoder gives them slots of their own.
template <auto F, class To, class A, class T>
void map1(const Operation& operation, Machine<T>& machine) {
    auto* __restrict result = To::of(machine, operation.result);
    const auto* a = A::of(machine, operation.operands[0]);
    const std::size_t cells = operation.count * kLanes;
    for (std::size_t i = 0; i < cells; ++i)
        result[i] = static_cast<std::remove_reference_t<decltype(*result)>>(F(a[i]));
}

template <auto F, class To, class A, class B, class T>
void map2(const Operation& operation, Machine<T>& machine) {
    auto* __restrict result = To::of(machine, operation.result);
    const auto* a = A::of(machine, operation.operands[0]);
    const auto* b = B::of(machine, operation.operands[1]);
    const std::size_t cells = operation.count * kLanes;
    for (std::size_t i = 0; i < cells; ++i)
        result[i] = static_cast<std::remove_reference_t<decltype(*result)>>(F(a[i], b[i]));
}

template <auto F, class To, class A, class B, class C, class T>
void map3(const Operation& operation, Machine<T>& machine) {
    auto* __restrict result = To::of(machine, operation.result);
    const auto* a = A::of(machine, operation.operands[0]);
    const auto* b = B::of(machine, operation.operands[1]);
    const auto* c = C::of(machine, operation.operands[2]);
    const std::size_t cells = operation.count * kLanes;
    for (std::size_t i = 0; i < cells; ++i)
        result[i] = static_cast<std::remove_reference_t<decltype(*result)>>(F(a[i], b[i], c[i]));
}

/// Functions that cost much more than a pass over the mask: active lanes only.
template <auto F, class T>
void costly1(const Operation& operation, Machine<T>& machine) {
    T* __restrict result = machine.reals(operation.result);
    const T* a = machine.reals(operation.operands[0]);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i)
        if (machine.is_active(i % kLanes)) result[i] = F(a[i]);
}

template <auto F, class T>
void costly2(const Operation& operation, Machine<T>& machine) {
    T* __restrict result = machine.reals(operation.result);
    const T* a = machine.reals(operation.operands[0]);
    const T* b = machine.reals(operation.operands[1]);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i)
        if (machine.is_active(i % kLanes)) result[i] = F(a[i], b[i]);
}

template <auto F, class To, class A>
inline constexpr Execution kMap1{&map1<F, To, A, float>, &map1<F, To, A, double>};
template <auto F, class To, class A, class B>
inline constexpr Execution kMap2{&map2<F, To, A, B, float>, &map2<F, To, A, B, double>};
template <auto F, class To, class A, class B, class C>
inline constexpr Execution kMap3{&map3<F, To, A, B, C, float>, &map3<F, To, A, B, C, double>};

/// Reals to reals.
template <auto F>
inline constexpr Execution kReal1 = kMap1<F, RealRows, RealRows>;
template <auto F>
inline constexpr Execution kReal2 = kMap2<F, RealRows, RealRows, RealRows>;
template <auto F>
inline constexpr Execution kReal3 = kMap3<F, RealRows, RealRows, RealRows, RealRows>;
template <auto F>
inline constexpr Execution kCostly1{&costly1<F, float>, &costly1<F, double>};
template <auto F>
inline constexpr Execution kCostly2{&costly2<F, float>, &costly2<F, double>};
/// Whole numbers to whole numbers.
template <auto F>
inline constexpr Execution kWhole1 = kMap1<F, WholeRows, WholeRows>;
template <auto F>
inline constexpr Execution kWhole2 = kMap2<F, WholeRows, WholeRows, WholeRows>;
template <auto F>
inline constexpr Execution kWhole3 = kMap3<F, WholeRows, WholeRows, WholeRows, WholeRows>;
/// Reals to truth values.
template <auto F>
inline constexpr Execution kTest1 = kMap1<F, WholeRows, RealRows>;
template <auto F>
inline constexpr Execution kTest2 = kMap2<F, WholeRows, RealRows, RealRows>;

// How an operation adds up the products it consists of: the parameter `Sums` of such rows.
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
struct Backwards {
    static constexpr bool kBackwards = true;
    template <class T>
    static T add_product(T sum, T a, T b) {
        return sum + a * b;
    }
};

}  // namespace gobo::evaluate
