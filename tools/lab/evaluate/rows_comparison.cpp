// Comparisons, logic and choices. Truth values are 0 and 1.
#include <cmath>

#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

/// Components of anything, by a condition of each component. What is chosen between is bytes: integers will
/// do.
constexpr auto kSelect = []<class T>(const Operation& operation, Registers<T>& registers) {
    const Int<T>* condition = registers.ints(operation.operands[0]);
    Int<T>* __restrict result = registers.ints(operation.result);
    const Int<T>* a = registers.ints(operation.operands[1]);
    const Int<T>* b = registers.ints(operation.operands[2]);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) result[i] = condition[i] != 0 ? a[i] : b[i];
};

/// The same by one condition.
constexpr auto kSelectWhole = []<class T>(const Operation& operation, Registers<T>& registers) {
    const Int<T>* condition = registers.ints(operation.operands[0]);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Int<T>* __restrict result = registers.ints(operation.result + component);
        const Int<T>* a = registers.ints(operation.operands[1] + component);
        const Int<T>* b = registers.ints(operation.operands[2] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = condition[lane] != 0 ? a[lane] : b[lane];
    }
};

/// all() and any().
template <bool kAll>
constexpr auto kReduce = []<class T>(const Operation& operation, Registers<T>& registers) {
    Int<T>* __restrict result = registers.ints(operation.result);
    for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = kAll ? 1 : 0;
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        const Int<T>* a = registers.ints(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = kAll ? (result[lane] & a[lane]) : (result[lane] | a[lane]);
    }
};

template <auto F>
constexpr Execution kSigned = kInts<[](auto a, auto b) { return F(to_signed(a), to_signed(b)); }>;
template <auto F>
constexpr Execution kUnsigned = kInts<[](auto a, auto b) { return F(to_unsigned(a), to_unsigned(b)); }>;
/// An ordered comparison is false where an operand is NaN, an unordered one true.
template <auto F>
constexpr Execution kUnordered =
    kTest<[](auto a, auto b) { return F(a, b) || std::isnan(a) || std::isnan(b); }>;

constexpr auto kEqual = [](auto a, auto b) { return a == b; };
constexpr auto kUnequal = [](auto a, auto b) { return a != b; };
constexpr auto kOrderedUnequal = [](auto a, auto b) { return a < b || b < a; };
constexpr auto kLess = [](auto a, auto b) { return a < b; };
constexpr auto kLessEqual = [](auto a, auto b) { return a <= b; };
constexpr auto kGreater = [](auto a, auto b) { return a > b; };
constexpr auto kGreaterEqual = [](auto a, auto b) { return a >= b; };

// The rows that compare floats (false or true where an operand is NaN), signed and unsigned integers.
#define GOBO_ORDER(name, function)                                              \
    {GOBO_CORE(FOrd##name), Kind::compare, "b:ff", kTest<function>},            \
        {GOBO_CORE(FUnord##name), Kind::compare, "b:ff", kUnordered<function>}, \
        {GOBO_CORE(S##name), Kind::compare, "b:ii", kSigned<function>}, {       \
        GOBO_CORE(U##name), Kind::compare, "b:ii", kUnsigned<function>          \
    }

constexpr Row kRows[] = {
    {GOBO_CORE(FOrdEqual), Kind::compare, "b:ff", kTest<kEqual>},
    {GOBO_CORE(FOrdNotEqual), Kind::compare, "b:ff", kTest<kOrderedUnequal>},
    {GOBO_CORE(FUnordEqual), Kind::compare, "b:ff", kUnordered<kEqual>},
    {GOBO_CORE(FUnordNotEqual), Kind::compare, "b:ff", kTest<kUnequal>},
    GOBO_ORDER(LessThan, kLess),
    GOBO_ORDER(LessThanEqual, kLessEqual),
    GOBO_ORDER(GreaterThan, kGreater),
    GOBO_ORDER(GreaterThanEqual, kGreaterEqual),
    {GOBO_CORE(IsNan), Kind::compare, "b:f", kTest<[](auto a) { return std::isnan(a); }>},
    {GOBO_CORE(IsInf), Kind::compare, "b:f", kTest<[](auto a) { return std::isinf(a); }>},
    {GOBO_CORE(IEqual), Kind::compare, "b:ii", kSigned<kEqual>},
    {GOBO_CORE(INotEqual), Kind::compare, "b:ii", kSigned<kUnequal>},
    {GOBO_CORE(LogicalEqual), Kind::logic, "b:bb", kSigned<kEqual>},
    {GOBO_CORE(LogicalNotEqual), Kind::logic, "b:bb", kSigned<kUnequal>},
    {GOBO_CORE(LogicalAnd), Kind::logic, "b:bb", kInts<[](auto a, auto b) { return a & b; }>},
    {GOBO_CORE(LogicalOr), Kind::logic, "b:bb", kInts<[](auto a, auto b) { return a | b; }>},
    {GOBO_CORE(LogicalNot), Kind::logic, "b:b", kInts<[](auto a) { return a ^ 1; }>},
    {GOBO_CORE(Any), Kind::logic, "B:b", kRun<kReduce<false>>},
    {GOBO_CORE(All), Kind::logic, "B:b", kRun<kReduce<true>>},
    {GOBO_CORE(Select), Kind::select, "*:b**", kRun<kSelect>},
    {GOBO_CORE(Select), Kind::select, "*:B**", kRun<kSelectWhole>},
};

#undef GOBO_ORDER

}  // namespace

constinit const std::span<const Row> kComparisonRows = kRows;

}  // namespace gobo::evaluate
