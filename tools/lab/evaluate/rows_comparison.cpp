// Comparisons, logic and choices. Truth values are 0 and 1.
#include <cmath>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

// An ordered comparison is false where an operand is NaN, an unordered one true.
template <class T>
bool unordered(T a, T b) {
    return std::isnan(a) || std::isnan(b);
}

/// Components of anything, by a condition of each component.
template <class T>
void select(const Operation& operation, Machine<T>& machine) {
    const Whole<T>* condition = machine.wholes(operation.operands[0]);
    // As whole numbers: their bytes are what is chosen between.
    Whole<T>* __restrict result = machine.wholes(operation.result);
    const Whole<T>* a = machine.wholes(operation.operands[1]);
    const Whole<T>* b = machine.wholes(operation.operands[2]);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) result[i] = condition[i] != 0 ? a[i] : b[i];
}

/// The same by one condition.
template <class T>
void select_whole(const Operation& operation, Machine<T>& machine) {
    const Whole<T>* condition = machine.wholes(operation.operands[0]);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Whole<T>* __restrict result = machine.wholes(operation.result + component);
        const Whole<T>* a = machine.wholes(operation.operands[1] + component);
        const Whole<T>* b = machine.wholes(operation.operands[2] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = condition[lane] != 0 ? a[lane] : b[lane];
    }
}

template <bool kAll, class T>
void reduce(const Operation& operation, Machine<T>& machine) {
    Whole<T>* __restrict result = machine.wholes(operation.result);
    for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = kAll ? 1 : 0;
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        const Whole<T>* a = machine.wholes(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = kAll ? (result[lane] & a[lane]) : (result[lane] | a[lane]);
    }
}

template <auto F>
inline constexpr Execution kSigned = kWhole2<[](auto a, auto b) { return F(to_signed(a), to_signed(b)); }>;
template <auto F>
inline constexpr Execution kUnsigned =
    kWhole2<[](auto a, auto b) { return F(to_unsigned(a), to_unsigned(b)); }>;

constexpr auto kEqual = [](auto a, auto b) { return a == b; };
constexpr auto kUnequal = [](auto a, auto b) { return a != b; };
constexpr auto kOrderedUnequal = [](auto a, auto b) { return a < b || b < a; };
constexpr auto kLess = [](auto a, auto b) { return a < b; };
constexpr auto kLessEqual = [](auto a, auto b) { return a <= b; };
constexpr auto kGreater = [](auto a, auto b) { return a > b; };
constexpr auto kGreaterEqual = [](auto a, auto b) { return a >= b; };
template <auto F>
inline constexpr auto kUnordered = [](auto a, auto b) { return F(a, b) || unordered(a, b); };

constexpr Row kRows[] = {
    {spv::OpFOrdEqual, "FOrdEqual", Kind::compare, "b:ff", kTest2<kEqual>},
    {spv::OpFOrdNotEqual, "FOrdNotEqual", Kind::compare, "b:ff", kTest2<kOrderedUnequal>},
    {spv::OpFOrdLessThan, "FOrdLessThan", Kind::compare, "b:ff", kTest2<kLess>},
    {spv::OpFOrdLessThanEqual, "FOrdLessThanEqual", Kind::compare, "b:ff", kTest2<kLessEqual>},
    {spv::OpFOrdGreaterThan, "FOrdGreaterThan", Kind::compare, "b:ff", kTest2<kGreater>},
    {spv::OpFOrdGreaterThanEqual, "FOrdGreaterThanEqual", Kind::compare, "b:ff", kTest2<kGreaterEqual>},
    {spv::OpFUnordEqual, "FUnordEqual", Kind::compare, "b:ff", kTest2<kUnordered<kEqual>>},
    {spv::OpFUnordNotEqual, "FUnordNotEqual", Kind::compare, "b:ff", kTest2<kUnequal>},
    {spv::OpFUnordLessThan, "FUnordLessThan", Kind::compare, "b:ff", kTest2<kUnordered<kLess>>},
    {spv::OpFUnordLessThanEqual, "FUnordLessThanEqual", Kind::compare, "b:ff",
     kTest2<kUnordered<kLessEqual>>},
    {spv::OpFUnordGreaterThan, "FUnordGreaterThan", Kind::compare, "b:ff", kTest2<kUnordered<kGreater>>},
    {spv::OpFUnordGreaterThanEqual, "FUnordGreaterThanEqual", Kind::compare, "b:ff",
     kTest2<kUnordered<kGreaterEqual>>},
    {spv::OpIsNan, "IsNan", Kind::compare, "b:f", kTest1<[](auto a) { return std::isnan(a); }>},
    {spv::OpIsInf, "IsInf", Kind::compare, "b:f", kTest1<[](auto a) { return std::isinf(a); }>},
    {spv::OpIEqual, "IEqual", Kind::compare, "b:ii", kSigned<kEqual>},
    {spv::OpINotEqual, "INotEqual", Kind::compare, "b:ii", kSigned<kUnequal>},
    {spv::OpSLessThan, "SLessThan", Kind::compare, "b:ii", kSigned<kLess>},
    {spv::OpSLessThanEqual, "SLessThanEqual", Kind::compare, "b:ii", kSigned<kLessEqual>},
    {spv::OpSGreaterThan, "SGreaterThan", Kind::compare, "b:ii", kSigned<kGreater>},
    {spv::OpSGreaterThanEqual, "SGreaterThanEqual", Kind::compare, "b:ii", kSigned<kGreaterEqual>},
    {spv::OpULessThan, "ULessThan", Kind::compare, "b:ii", kUnsigned<kLess>},
    {spv::OpULessThanEqual, "ULessThanEqual", Kind::compare, "b:ii", kUnsigned<kLessEqual>},
    {spv::OpUGreaterThan, "UGreaterThan", Kind::compare, "b:ii", kUnsigned<kGreater>},
    {spv::OpUGreaterThanEqual, "UGreaterThanEqual", Kind::compare, "b:ii", kUnsigned<kGreaterEqual>},
    {spv::OpLogicalEqual, "LogicalEqual", Kind::logic, "b:bb", kSigned<kEqual>},
    {spv::OpLogicalNotEqual, "LogicalNotEqual", Kind::logic, "b:bb", kSigned<kUnequal>},
    {spv::OpLogicalAnd, "LogicalAnd", Kind::logic, "b:bb", kWhole2<[](auto a, auto b) { return a & b; }>},
    {spv::OpLogicalOr, "LogicalOr", Kind::logic, "b:bb", kWhole2<[](auto a, auto b) { return a | b; }>},
    {spv::OpLogicalNot, "LogicalNot", Kind::logic, "b:b", kWhole1<[](auto a) { return a ^ 1; }>},
    {spv::OpAny, "Any", Kind::logic, "B:b", {&reduce<false, float>, &reduce<false, double>}},
    {spv::OpAll, "All", Kind::logic, "B:b", {&reduce<true, float>, &reduce<true, double>}},
    {spv::OpSelect, "Select", Kind::select, "*:b**", {&select<float>, &select<double>}},
    {spv::OpSelect, "Select", Kind::select, "*:B**", {&select_whole<float>, &select_whole<double>}},
};

}  // namespace

std::span<const Row> comparison_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
