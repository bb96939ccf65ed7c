// Makes rows out of functions of a component or of a row. Internal to evaluation.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/registers.hpp"

// The code and the name of an instruction of SPIR-V itself, and of one of GLSL.std.450.
#define GOBO_CORE(name) spv::Op##name, #name
#define GOBO_EXTENDED(name) kExtended + GLSLstd450##name, #name

namespace gobo::evaluate {

/// Runs `F(operation, registers)`.
template <auto F>
inline constexpr Execution kRun{
    [](const Operation& operation, Registers<float>& registers) { F(operation, registers); },
    [](const Operation& operation, Registers<double>& registers) { F(operation, registers); }};

/// The rows of an operand or result.
struct Floats {
    template <class T>
    static T* of(Registers<T>& registers, std::uint32_t slot) {
        return registers.floats(slot);
    }
};
struct Ints {
    template <class T>
    static Int<T>* of(Registers<T>& registers, std::uint32_t slot) {
        return registers.ints(slot);
    }
};

/// Results never overlap operands: the decoder gives them slots of their own.
template <auto F, class Result, class... Operand>
void fill(Result* __restrict result, std::size_t cells, const Operand*... operands) {
    for (std::size_t i = 0; i < cells; ++i) result[i] = static_cast<Result>(F(operands[i]...));
}

/// `F` of each component of all lanes: the compiler turns the loop into vector instructions.
template <auto F, class To, class... From>
inline constexpr auto kEach = [](const Operation& operation, auto& registers) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        fill<F>(To::of(registers, operation.result), operation.count * kLanes,
                From::of(registers, operation.operands[I])...);
    }
    (std::index_sequence_for<From...>());
};
template <auto F, class To, class... From>
inline constexpr Execution kMap = kRun<kEach<F, To, From...>>;

/// The same with one to three operands, as many as `F` takes.
template <auto F, class To, class From, class Cell>
constexpr Execution map_all() {
    if constexpr (std::is_invocable_v<decltype(F), Cell>)
        return kMap<F, To, From>;
    else if constexpr (std::is_invocable_v<decltype(F), Cell, Cell>)
        return kMap<F, To, From, From>;
    else
        return kMap<F, To, From, From, From>;
}
/// Floats to floats.
template <auto F>
inline constexpr Execution kFloats = map_all<F, Floats, Floats, float>();
/// Integers to integers.
template <auto F>
inline constexpr Execution kInts = map_all<F, Ints, Ints, std::int32_t>();
/// Floats to integers and booleans.
template <auto F>
inline constexpr Execution kTest = map_all<F, Ints, Floats, float>();

/// Calls `compute` with the rows of each component of the result and of the first two operands.
template <class Rows, class T, class Compute>
void for_each_component(const Operation& operation, Registers<T>& registers, const Compute& compute) {
    for (std::uint32_t component = 0; component < operation.count; ++component)
        compute(Rows::of(registers, operation.result + component),
                Rows::of(registers, operation.operands[0] + component),
                Rows::of(registers, operation.operands[1] + component));
}

/// Of one or two floats, for functions that cost much more than a look at the mask: active lanes only.
template <auto F>
inline constexpr Execution kCostly = kRun<[](const Operation& operation, auto& registers) {
    auto* __restrict result = registers.floats(operation.result);
    const auto* a = registers.floats(operation.operands[0]);
    const auto* b = registers.floats(operation.operands[1]);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) {
        if (!registers.is_active(i % kLanes)) continue;
        if constexpr (std::is_invocable_v<decltype(F), float>)
            result[i] = F(a[i]);
        else
            result[i] = F(a[i], b[i]);
    }
}>;

/// The distance from a result to the next fp32 number away from 0.
inline double ulp(double value) {
    const float size = std::fabs(static_cast<float>(value));
    return static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity())) -
           static_cast<double>(size);
}

// min and max as GLSL defines them: what a NaN operand gives follows from the comparison being false.
inline constexpr auto kMin = [](auto x, auto y) { return y < x ? y : x; };
inline constexpr auto kMax = [](auto x, auto y) { return x < y ? y : x; };

}  // namespace gobo::evaluate
