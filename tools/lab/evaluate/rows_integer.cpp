// Arithmetic and bit operations of 32-bit integers, and what is packed into them. What GLSL leaves undefined
// (division by 0, shifts by 32 and more) has a value here: 0 for the former, the amount modulo 32 for the
// latter.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "lab/evaluate/half.hpp"
#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

// Functions of operands taken as unsigned or as signed integers.
template <auto F>
constexpr Execution kUnsigned1 = kInts<[](auto a) { return to_signed(F(to_unsigned(a))); }>;
template <auto F>
constexpr Execution kUnsigned2 =
    kInts<[](auto a, auto b) { return to_signed(F(to_unsigned(a), to_unsigned(b))); }>;
template <auto F>
constexpr Execution kSigned2 = kInts<[](auto a, auto b) { return to_signed(F(to_signed(a), to_signed(b))); }>;

constexpr auto kDivide = [](std::int64_t a, std::int64_t b) { return b == 0 ? 0 : a / b; };
constexpr auto kRemainder = [](std::int64_t a, std::int64_t b) { return b == 0 ? 0 : a % b; };
/// The sign of the result is that of b.
constexpr auto kModulo = [](std::int64_t a, std::int64_t b) {
    const std::int64_t rest = kRemainder(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
};

constexpr auto kReverseBits = [](std::uint32_t a) {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (a >> bit & 1U) << (31 - bit);
    return reversed;
};
/// Index of the highest set bit, -1 for 0.
constexpr auto kHighestBit = [](std::uint32_t a) { return 31 - std::countl_zero(a); };
constexpr auto kLowestBit = [](std::uint32_t a) { return a == 0 ? -1 : std::countr_zero(a); };

constexpr std::uint32_t bits(std::uint32_t count) {
    return count >= 32 ? ~0U : (1U << count) - 1U;
}

/// Fields at an offset and of a size that are the same for all components.
template <bool kIsSigned>
constexpr auto kBitFieldExtract = [](const Operation& operation, auto& registers) {
    const auto* value = registers.ints(operation.operands[0]);
    const auto* offset = registers.ints(operation.operands[1]);
    const auto* size = registers.ints(operation.operands[2]);
    auto* result = registers.ints(operation.result);
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const std::uint32_t from = to_unsigned(offset[i % kLanes]);
        const std::uint32_t count = to_unsigned(size[i % kLanes]);
        std::uint32_t field = from >= 32 ? 0 : to_unsigned(value[i]) >> from & bits(count);
        if (kIsSigned && count != 0 && count < 32 && (field >> (count - 1) & 1U) != 0) field |= ~bits(count);
        result[i] = to_signed(field);
    }
};

constexpr auto kBitFieldInsert = [](const Operation& operation, auto& registers) {
    const auto* base = registers.ints(operation.operands[0]);
    const auto* insert = registers.ints(operation.operands[1]);
    const auto* offset = registers.ints(registers.words(operation)[0]);
    const auto* size = registers.ints(registers.words(operation)[1]);
    auto* result = registers.ints(operation.result);
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const std::uint32_t from = to_unsigned(offset[i % kLanes]);
        const std::uint32_t field = from >= 32 ? 0 : bits(to_unsigned(size[i % kLanes])) << from;
        const std::uint32_t moved = from >= 32 ? 0 : to_unsigned(insert[i]) << from;
        result[i] = to_signed((to_unsigned(base[i]) & ~field) | (moved & field));
    }
};

/// Two results: the low word (or the sum), then the high word (or the carry).
template <auto F>
constexpr Execution kTwoWords = kRun<[](const Operation& operation, auto& registers) {
    const auto* a = registers.ints(operation.operands[0]);
    const auto* b = registers.ints(operation.operands[1]);
    auto* low = registers.ints(operation.result);
    auto* high = registers.ints(operation.result + operation.count);
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const auto wide = static_cast<std::uint64_t>(F(to_signed(a[i]), to_signed(b[i])));
        low[i] = to_signed(wide);
        high[i] = to_signed(wide >> 32U);
    }
}>;
constexpr auto kAddCarry = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} + b; };
constexpr auto kSubBorrow = [](std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{a - b} | (std::uint64_t{a < b} << 32U);
};
constexpr auto kUnsignedProduct = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} * b; };
constexpr auto kSignedProduct = [](std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; };

constexpr auto kShiftLeft = [](std::uint32_t a, std::uint32_t b) { return a << (b & 31U); };
constexpr auto kShiftRight = [](std::uint32_t a, std::uint32_t b) { return a >> (b & 31U); };
constexpr auto kShiftSigned = [](auto a, auto b) { return to_signed(a) >> (to_unsigned(b) & 31U); };
constexpr auto kHighestOfSigned = [](std::uint32_t a) { return kHighestBit(to_signed(a) < 0 ? ~a : a); };
constexpr auto kAbs = [](std::uint32_t a) { return to_signed(a) < 0 ? 0U - a : a; };
constexpr auto kSign = [](auto a) { return (to_signed(a) > 0) - (to_signed(a) < 0); };
constexpr auto kClampUnsigned = [](auto x, auto low, auto high) {
    return to_signed(kMin(kMax(to_unsigned(x), to_unsigned(low)), to_unsigned(high)));
};
constexpr auto kClampSigned = [](auto x, auto low, auto high) {
    return kMin(kMax(to_signed(x), to_signed(low)), to_signed(high));
};

// Packing of floats into integers, as the GLSL specification, 8.4, rounds and clamps them.

/// Integers of `kWidth` bits that stand for [0, 1], or for [-1, 1] where they are signed.
template <std::uint32_t kWidth, class Integer>
struct Normalized {
    static constexpr std::uint32_t kBits = kWidth;
    static constexpr double kLow = std::is_signed_v<Integer> ? -1.0 : 0.0;
    static constexpr double kScale = std::numeric_limits<Integer>::max();

    static std::uint32_t pack(double x) {
        // NaN has no place in these formats; a conversion of it would be undefined here too.
        if (std::isnan(x)) return 0;
        return static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::round(std::clamp(x, kLow, 1.0) * kScale)));
    }
    static double unpack(std::uint32_t field) {
        return std::clamp(static_cast<Integer>(field) / kScale, kLow, 1.0);
    }
};
using Unorm8 = Normalized<8, std::uint8_t>;
using Snorm8 = Normalized<8, std::int8_t>;
using Unorm16 = Normalized<16, std::uint16_t>;
using Snorm16 = Normalized<16, std::int16_t>;

template <class Format>
constexpr std::uint32_t kMask = (1U << Format::kBits) - 1U;

template <class Format>
constexpr Execution kPack = kRun<[](const Operation& operation, auto& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        std::uint32_t packed = 0;
        for (std::uint32_t component = 0; component < 32 / Format::kBits; ++component) {
            const auto value = static_cast<double>(registers.floats(operation.operands[0] + component)[lane]);
            packed |= (Format::pack(value) & kMask<Format>) << (component * Format::kBits);
        }
        registers.ints(operation.result)[lane] = to_signed(packed);
    }
}>;

template <class Format>
constexpr Execution kUnpack = kRun<[]<class T>(const Operation& operation, Registers<T>& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t packed = to_unsigned(registers.ints(operation.operands[0])[lane]);
        for (std::uint32_t component = 0; component < 32 / Format::kBits; ++component)
            registers.floats(operation.result + component)[lane] =
                static_cast<T>(Format::unpack(packed >> (component * Format::kBits) & kMask<Format>));
    }
}>;

constexpr Row kRows[] = {
    {GOBO_CORE(SNegate), Kind::integer, "i:i", kUnsigned1<[](auto a) { return 0U - a; }>},
    {GOBO_CORE(IAdd), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a + b; }>},
    {GOBO_CORE(ISub), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a - b; }>},
    {GOBO_CORE(IMul), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a * b; }>},
    {GOBO_CORE(UDiv), Kind::integer, "i:ii", kUnsigned2<kDivide>},
    {GOBO_CORE(SDiv), Kind::integer, "i:ii", kSigned2<kDivide>},
    {GOBO_CORE(UMod), Kind::integer, "i:ii", kUnsigned2<kRemainder>},
    {GOBO_CORE(SRem), Kind::integer, "i:ii", kSigned2<kRemainder>},
    {GOBO_CORE(SMod), Kind::integer, "i:ii", kSigned2<kModulo>},
    {GOBO_CORE(IAddCarry), Kind::integer, "s:ii", kTwoWords<kAddCarry>},
    {GOBO_CORE(ISubBorrow), Kind::integer, "s:ii", kTwoWords<kSubBorrow>},
    {GOBO_CORE(UMulExtended), Kind::integer, "s:ii", kTwoWords<kUnsignedProduct>},
    {GOBO_CORE(SMulExtended), Kind::integer, "s:ii", kTwoWords<kSignedProduct>},
    {GOBO_CORE(Not), Kind::integer, "i:i", kUnsigned1<[](auto a) { return ~a; }>},
    {GOBO_CORE(BitwiseAnd), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a & b; }>},
    {GOBO_CORE(BitwiseOr), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a | b; }>},
    {GOBO_CORE(BitwiseXor), Kind::integer, "i:ii", kUnsigned2<[](auto a, auto b) { return a ^ b; }>},
    {GOBO_CORE(ShiftLeftLogical), Kind::integer, "i:ii", kUnsigned2<kShiftLeft>},
    {GOBO_CORE(ShiftRightLogical), Kind::integer, "i:ii", kUnsigned2<kShiftRight>},
    {GOBO_CORE(ShiftRightArithmetic), Kind::integer, "i:ii", kInts<kShiftSigned>},
    {GOBO_CORE(BitReverse), Kind::integer, "i:i", kUnsigned1<kReverseBits>},
    {GOBO_CORE(BitCount), Kind::integer, "i:i", kUnsigned1<[](auto a) { return std::popcount(a); }>},
    {GOBO_CORE(BitFieldUExtract), Kind::integer, "i:iII", kRun<kBitFieldExtract<false>>},
    {GOBO_CORE(BitFieldSExtract), Kind::integer, "i:iII", kRun<kBitFieldExtract<true>>},
    {GOBO_CORE(BitFieldInsert), Kind::integer, "i:iiII", kRun<kBitFieldInsert>},
    {GOBO_EXTENDED(FindILsb), Kind::integer, "i:i", kUnsigned1<kLowestBit>},
    {GOBO_EXTENDED(FindSMsb), Kind::integer, "i:i", kUnsigned1<kHighestOfSigned>},
    {GOBO_EXTENDED(FindUMsb), Kind::integer, "i:i", kUnsigned1<kHighestBit>},
    {GOBO_EXTENDED(SAbs), Kind::integer, "i:i", kUnsigned1<kAbs>},
    {GOBO_EXTENDED(SSign), Kind::integer, "i:i", kInts<kSign>},
    {GOBO_EXTENDED(UMin), Kind::integer, "i:ii", kUnsigned2<kMin>},
    {GOBO_EXTENDED(SMin), Kind::integer, "i:ii", kSigned2<kMin>},
    {GOBO_EXTENDED(UMax), Kind::integer, "i:ii", kUnsigned2<kMax>},
    {GOBO_EXTENDED(SMax), Kind::integer, "i:ii", kSigned2<kMax>},
    {GOBO_EXTENDED(UClamp), Kind::integer, "i:iii", kInts<kClampUnsigned>},
    {GOBO_EXTENDED(SClamp), Kind::integer, "i:iii", kInts<kClampSigned>},
    {GOBO_EXTENDED(PackSnorm4x8), Kind::convert, "I:f4", kPack<Snorm8>},
    {GOBO_EXTENDED(PackUnorm4x8), Kind::convert, "I:f4", kPack<Unorm8>},
    {GOBO_EXTENDED(PackSnorm2x16), Kind::convert, "I:f2", kPack<Snorm16>},
    {GOBO_EXTENDED(PackUnorm2x16), Kind::convert, "I:f2", kPack<Unorm16>},
    {GOBO_EXTENDED(PackHalf2x16), Kind::convert, "I:f2", kPack<Half>},
    {GOBO_EXTENDED(UnpackSnorm4x8), Kind::convert, "f:I4", kUnpack<Snorm8>},
    {GOBO_EXTENDED(UnpackUnorm4x8), Kind::convert, "f:I4", kUnpack<Unorm8>},
    {GOBO_EXTENDED(UnpackSnorm2x16), Kind::convert, "f:I2", kUnpack<Snorm16>},
    {GOBO_EXTENDED(UnpackUnorm2x16), Kind::convert, "f:I2", kUnpack<Unorm16>},
    {GOBO_EXTENDED(UnpackHalf2x16), Kind::convert, "f:I2", kUnpack<Half>},
};

}  // namespace

constinit const std::span<const Row> kIntegerRows = kRows;

}  // namespace gobo::evaluate
