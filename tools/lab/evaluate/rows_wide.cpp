// Integers of 64 bits, and the bits of floats that have not 32. Rows of doubles alone can hold them: stages
// with numbers of 64 bits are evaluated in those. What GLSL leaves undefined is as in rows_integer.cpp.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

using Signed = std::int64_t;
using Unsigned = std::uint64_t;

template <auto F>
constexpr Execution kSigned = map_all<F, Ints, Ints, Signed>();
template <auto F>
constexpr Execution kUnsigned1 =
    kSigned<[](Signed a) { return static_cast<Signed>(F(static_cast<Unsigned>(a))); }>;
template <auto F>
constexpr Execution kUnsigned2 = kSigned<[](Signed a, Signed b) {
    return static_cast<Signed>(F(static_cast<Unsigned>(a), static_cast<Unsigned>(b)));
}>;

/// The least integer by -1 wraps, as everywhere.
constexpr auto kDivide = [](Signed a, Signed b) {
    if (b == -1) return static_cast<Signed>(0 - static_cast<Unsigned>(a));
    return b == 0 ? 0 : a / b;
};
constexpr auto kRemainder = [](Signed a, Signed b) { return b == 0 || b == -1 ? 0 : a % b; };
constexpr auto kModulo = [](Signed a, Signed b) {
    const Signed rest = kRemainder(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
};
constexpr auto kSaturateSigned = [](auto value) {
    const auto wide = static_cast<double>(value);
    if (std::isnan(wide)) return Signed{0};
    if (wide >= 0x1p63) return std::numeric_limits<Signed>::max();
    return wide <= -0x1p63 ? std::numeric_limits<Signed>::min() : static_cast<Signed>(wide);
};
constexpr auto kSaturateUnsigned = [](auto value) {
    const auto wide = static_cast<double>(value);
    if (std::isnan(wide) || wide <= 0) return Signed{0};
    return static_cast<Signed>(wide >= 0x1p64 ? ~Unsigned{0} : static_cast<Unsigned>(wide));
};

/// Two words of 32 bits, the low one first.
constexpr auto kToWords = [](const Operation& operation, auto& registers, auto bits_of) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Unsigned bits = bits_of(operation.operands[0], lane);
        registers.ints(operation.result)[lane] = to_signed(bits);
        registers.ints(operation.result + 1)[lane] = to_signed(bits >> 32U);
    }
};
constexpr auto kFromWords = [](const Operation& operation, auto& registers, std::size_t lane) {
    return Unsigned{to_unsigned(registers.ints(operation.operands[0])[lane])} |
           Unsigned{to_unsigned(registers.ints(operation.operands[0] + 1)[lane])} << 32U;
};
constexpr auto kUnpackDouble = []<class T>(const Operation& operation, Registers<T>& registers) {
    kToWords(operation, registers, [&](std::uint32_t slot, std::size_t lane) {
        return std::bit_cast<Unsigned>(static_cast<double>(registers.floats(slot)[lane]));
    });
};
constexpr auto kPackDouble = []<class T>(const Operation& operation, Registers<T>& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        registers.floats(operation.result)[lane] =
            static_cast<T>(std::bit_cast<double>(kFromWords(operation, registers, lane)));
};
constexpr auto kUnpackInteger = []<class T>(const Operation& operation, Registers<T>& registers) {
    kToWords(operation, registers, [&](std::uint32_t slot, std::size_t lane) {
        return static_cast<Unsigned>(registers.ints(slot)[lane]);
    });
};
constexpr auto kPackInteger = []<class T>(const Operation& operation, Registers<T>& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        registers.ints(operation.result)[lane] = static_cast<Int<T>>(kFromWords(operation, registers, lane));
};

constexpr auto kBitsOfDouble = [](auto value) { return std::bit_cast<Signed>(static_cast<double>(value)); };
constexpr auto kDoubleOf = [](Signed bits) { return std::bit_cast<double>(bits); };
constexpr auto kSame = [](Signed a) { return a; };

constexpr auto kShiftLeft = [](Unsigned a, Unsigned b) { return a << (b & 63U); };
constexpr auto kShiftRight = [](Unsigned a, Unsigned b) { return a >> (b & 63U); };
constexpr auto kShiftSigned = [](Signed a, Signed b) { return a >> (b & 63); };
constexpr auto kSign = [](Signed a) { return (a > 0) - (a < 0); };
constexpr auto kLess = [](auto a, auto b) { return a < b; };
constexpr auto kLessEqual = [](auto a, auto b) { return a <= b; };
constexpr auto kGreater = [](auto a, auto b) { return a > b; };
constexpr auto kGreaterEqual = [](auto a, auto b) { return a >= b; };

#define GOBO_ORDER(name, function)                                                                           \
    {GOBO_CORE(S##name), Kind::compare, "b:ll", kSigned<[](Signed a, Signed b) { return function(a, b); }>}, \
    {                                                                                                        \
        GOBO_CORE(U##name), Kind::compare, "b:ll", kUnsigned2<function>                                      \
    }

constexpr Row kRows[] = {
    {GOBO_CORE(SNegate), Kind::integer, "l:l", kUnsigned1<[](Unsigned a) { return 0 - a; }>},
    {GOBO_CORE(IAdd), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a + b; }>},
    {GOBO_CORE(ISub), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a - b; }>},
    {GOBO_CORE(IMul), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a * b; }>},
    {GOBO_CORE(UDiv), Kind::integer, "l:ll",
     kUnsigned2<[](Unsigned a, Unsigned b) { return b == 0 ? 0 : a / b; }>},
    {GOBO_CORE(UMod), Kind::integer, "l:ll",
     kUnsigned2<[](Unsigned a, Unsigned b) { return b == 0 ? 0 : a % b; }>},
    {GOBO_CORE(SDiv), Kind::integer, "l:ll", kSigned<kDivide>},
    {GOBO_CORE(SRem), Kind::integer, "l:ll", kSigned<kRemainder>},
    {GOBO_CORE(SMod), Kind::integer, "l:ll", kSigned<kModulo>},
    {GOBO_CORE(Not), Kind::integer, "l:l", kUnsigned1<[](Unsigned a) { return ~a; }>},
    {GOBO_CORE(BitwiseAnd), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a & b; }>},
    {GOBO_CORE(BitwiseOr), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a | b; }>},
    {GOBO_CORE(BitwiseXor), Kind::integer, "l:ll", kUnsigned2<[](Unsigned a, Unsigned b) { return a ^ b; }>},
    {GOBO_CORE(ShiftLeftLogical), Kind::integer, "l:ll", kUnsigned2<kShiftLeft>},
    {GOBO_CORE(ShiftLeftLogical), Kind::integer, "l:li", kUnsigned2<kShiftLeft>},
    {GOBO_CORE(ShiftRightLogical), Kind::integer, "l:ll", kUnsigned2<kShiftRight>},
    {GOBO_CORE(ShiftRightLogical), Kind::integer, "l:li", kUnsigned2<kShiftRight>},
    {GOBO_CORE(ShiftRightArithmetic), Kind::integer, "l:ll", kSigned<kShiftSigned>},
    {GOBO_CORE(ShiftRightArithmetic), Kind::integer, "l:li", kSigned<kShiftSigned>},
    {GOBO_EXTENDED(SAbs), Kind::integer, "l:l",
     kUnsigned1<[](Unsigned a) { return static_cast<Signed>(a) < 0 ? 0 - a : a; }>},
    {GOBO_EXTENDED(SSign), Kind::integer, "l:l", kSigned<kSign>},
    {GOBO_EXTENDED(SMin), Kind::integer, "l:ll", kSigned<[](Signed a, Signed b) { return std::min(a, b); }>},
    {GOBO_EXTENDED(SMax), Kind::integer, "l:ll", kSigned<[](Signed a, Signed b) { return std::max(a, b); }>},
    {GOBO_EXTENDED(UMin), Kind::integer, "l:ll",
     kUnsigned2<[](Unsigned a, Unsigned b) { return std::min(a, b); }>},
    {GOBO_EXTENDED(UMax), Kind::integer, "l:ll",
     kUnsigned2<[](Unsigned a, Unsigned b) { return std::max(a, b); }>},
    {GOBO_EXTENDED(SClamp), Kind::integer, "l:lll",
     kSigned<[](Signed x, Signed low, Signed high) { return std::min(std::max(x, low), high); }>},
    {GOBO_EXTENDED(UClamp), Kind::integer, "l:lll", kSigned<[](Signed x, Signed low, Signed high) {
         return static_cast<Signed>(std::min(std::max(static_cast<Unsigned>(x), static_cast<Unsigned>(low)),
                                             static_cast<Unsigned>(high)));
     }>},
    {GOBO_CORE(IEqual), Kind::compare, "b:ll", kSigned<[](Signed a, Signed b) { return a == b; }>},
    {GOBO_CORE(INotEqual), Kind::compare, "b:ll", kSigned<[](Signed a, Signed b) { return a != b; }>},
    GOBO_ORDER(LessThan, kLess),
    GOBO_ORDER(LessThanEqual, kLessEqual),
    GOBO_ORDER(GreaterThan, kGreater),
    GOBO_ORDER(GreaterThanEqual, kGreaterEqual),
    {GOBO_CORE(ConvertFToS), Kind::convert, "l:f", kTest<kSaturateSigned>},
    {GOBO_CORE(ConvertFToU), Kind::convert, "l:f", kTest<kSaturateUnsigned>},
    {GOBO_CORE(ConvertSToF), Kind::convert, "f:l", kMap<[](Signed a) { return a; }, Floats, Ints>},
    {GOBO_CORE(ConvertUToF), Kind::convert, "f:l",
     kMap<[](Signed a) { return static_cast<Unsigned>(a); }, Floats, Ints>},
    {GOBO_CORE(FConvert), Kind::convert, "f:f", kFloats<[](auto a) { return a; }>},
    {GOBO_CORE(SConvert), Kind::convert, "l:i", kInts<[](auto a) { return to_signed(a); }>},
    {GOBO_CORE(SConvert), Kind::convert, "l:l", kSigned<kSame>},
    {GOBO_CORE(SConvert), Kind::convert, "i:l", kInts<[](auto a) { return to_signed(a); }>},
    {GOBO_CORE(UConvert), Kind::convert, "l:i", kInts<[](auto a) { return to_unsigned(a); }>},
    {GOBO_CORE(UConvert), Kind::convert, "l:l", kSigned<kSame>},
    {GOBO_CORE(UConvert), Kind::convert, "i:l", kInts<[](auto a) { return to_signed(a); }>},
    {GOBO_CORE(Bitcast), Kind::convert, "l:d", kTest<kBitsOfDouble>},
    {GOBO_CORE(Bitcast), Kind::convert, "d:l", kMap<kDoubleOf, Floats, Ints>},
    {GOBO_CORE(Bitcast), Kind::convert, "l:l", kSigned<kSame>},
    {GOBO_CORE(Bitcast), Kind::convert, "i:L2", kRun<kUnpackInteger>},
    {GOBO_CORE(Bitcast), Kind::convert, "L:i2", kRun<kPackInteger>},
    {GOBO_EXTENDED(PackDouble2x32), Kind::convert, "D:i2", kRun<kPackDouble>},
    {GOBO_EXTENDED(UnpackDouble2x32), Kind::convert, "i:D2", kRun<kUnpackDouble>},
};

#undef GOBO_ORDER

}  // namespace

constinit const std::span<const Row> kWideRows = kRows;

}  // namespace gobo::evaluate
