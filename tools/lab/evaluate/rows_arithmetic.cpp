// Arithmetic of reals, component by component.
#include <cmath>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// n reals times one.
template <class T>
void scale(const Operation& operation, Machine<T>& machine) {
    const T* b = machine.reals(operation.operands[1]);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* a = machine.reals(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = a[lane] * b[lane];
    }
}

// GLSL.std.450 gives the formulas where they are more than one operation.
constexpr Row kRows[] = {
    {spv::OpFNegate, "FNegate", Kind::add, "f:f", kReal1<[](auto a) { return -a; }>},
    {spv::OpFAdd, "FAdd", Kind::add, "f:ff", kReal2<[](auto a, auto b) { return a + b; }>},
    {spv::OpFSub, "FSub", Kind::add, "f:ff", kReal2<[](auto a, auto b) { return a - b; }>},
    {spv::OpFMul, "FMul", Kind::mul, "f:ff", kReal2<[](auto a, auto b) { return a * b; }>},
    {spv::OpFDiv, "FDiv", Kind::div, "f:ff", kReal2<[](auto a, auto b) { return a / b; }>},
    {spv::OpFRem, "FRem", Kind::div, "f:ff", kReal2<[](auto a, auto b) { return std::fmod(a, b); }>},
    {spv::OpFMod, "FMod", Kind::div, "f:ff",
     kReal2<[](auto a, auto b) { return a - b * std::floor(a / b); }>},
    {spv::OpVectorTimesScalar, "VectorTimesScalar", Kind::mul, "f:fF", {&scale<float>, &scale<double>}},
    {spv::OpMatrixTimesScalar, "MatrixTimesScalar", Kind::mul, "", {&scale<float>, &scale<double>}},
};

}  // namespace

std::span<const Row> arithmetic_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
