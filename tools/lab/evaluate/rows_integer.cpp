// Arithmetic and bit operations of 32-bit integers. What GLSL leaves undefined (division by 0, shifts by 32
// and more) has a value here: 0 for the former, the amount modulo 32 for the latter.
#include <algorithm>
#include <bit>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

template <auto F>
inline constexpr auto kUnsigned2 =
    [](auto a, auto b) { return to_signed(F(to_unsigned(a), to_unsigned(b))); };
template <auto F>
inline constexpr auto kSigned2 = [](auto a, auto b) { return to_signed(F(to_signed(a), to_signed(b))); };

constexpr std::int64_t divide(std::int64_t a, std::int64_t b) {
    return b == 0 ? 0 : a / b;
}
constexpr std::int64_t remainder(std::int64_t a, std::int64_t b) {
    return b == 0 ? 0 : a % b;
}
/// The sign of the result is that of b.
constexpr std::int64_t modulo(std::int64_t a, std::int64_t b) {
    const std::int64_t rest = remainder(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

constexpr std::uint32_t reverse_bits(std::uint32_t a) {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (a >> bit & 1U) << (31 - bit);
    return reversed;
}
/// Index of the highest set bit, -1 for 0.
constexpr std::int32_t highest_bit(std::uint32_t a) {
    return 31 - std::countl_zero(a);
}
constexpr std::int32_t lowest_bit(std::uint32_t a) {
    return a == 0 ? -1 : std::countr_zero(a);
}

constexpr std::uint32_t bits(std::uint32_t count) {
    return count >= 32 ? ~0U : (1U << count) - 1U;
}
constexpr std::uint32_t extract(std::uint32_t value, std::uint32_t offset, std::uint32_t count) {
    return offset >= 32 ? 0 : value >> offset & bits(count);
}
constexpr std::int32_t extract_signed(std::uint32_t value, std::uint32_t offset, std::uint32_t count) {
    const std::uint32_t field = extract(value, offset, count);
    if (count == 0 || count >= 32 || (field >> (count - 1) & 1U) == 0)
        return static_cast<std::int32_t>(field);
    return static_cast<std::int32_t>(field | ~bits(count));
}

/// Fields at an offset and of a size that are the same for all components.
template <bool kIsSigned, class T>
void bit_field_extract(const Operation& operation, Machine<T>& machine) {
    const Whole<T>* offset = machine.wholes(operation.operands[1]);
    const Whole<T>* count = machine.wholes(operation.operands[2]);
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const std::uint32_t value = to_unsigned(machine.wholes(operation.operands[0])[i]);
        const std::uint32_t from = to_unsigned(offset[i % kLanes]);
        const std::uint32_t size = to_unsigned(count[i % kLanes]);
        machine.wholes(operation.result)[i] =
            kIsSigned ? extract_signed(value, from, size) : to_signed(extract(value, from, size));
    }
}

template <class T>
void bit_field_insert(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* slots = machine.words(operation);  // offset, count
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const std::uint32_t base = to_unsigned(machine.wholes(operation.operands[0])[i]);
        const std::uint32_t insert = to_unsigned(machine.wholes(operation.operands[1])[i]);
        const std::uint32_t from = to_unsigned(machine.wholes(slots[0])[i % kLanes]);
        const std::uint32_t size = to_unsigned(machine.wholes(slots[1])[i % kLanes]);
        const std::uint32_t field = from >= 32 ? 0 : bits(size) << from;
        machine.wholes(operation.result)[i] =
            to_signed((base & ~field) | (from >= 32 ? 0 : insert << from & field));
    }
}

/// Two results: the low word (or the sum), then the high word (or the carry).
template <auto F, class T>
void two_words(const Operation& operation, Machine<T>& machine) {
    for (std::uint32_t i = 0; i < operation.count * kLanes; ++i) {
        const std::uint64_t wide =
            F(machine.wholes(operation.operands[0])[i], machine.wholes(operation.operands[1])[i]);
        machine.wholes(operation.result)[i] = to_signed(wide);
        machine.wholes(operation.result + operation.count)[i] = to_signed(wide >> 32U);
    }
}
template <auto F>
inline constexpr Execution kTwoWords{&two_words<F, float>, &two_words<F, double>};

constexpr auto kAddCarry = [](auto a, auto b) { return std::uint64_t{to_unsigned(a)} + to_unsigned(b); };
constexpr auto kSubBorrow = [](auto a, auto b) {
    const std::uint32_t x = to_unsigned(a);
    const std::uint32_t y = to_unsigned(b);
    return std::uint64_t{x - y} | (std::uint64_t{x < y} << 32U);
};
constexpr auto kUnsignedProduct = [](auto a, auto b) {
    return std::uint64_t{to_unsigned(a)} * to_unsigned(b);
};
constexpr auto kSignedProduct = [](auto a, auto b) {
    return static_cast<std::uint64_t>(std::int64_t{to_signed(a)} * to_signed(b));
};

constexpr auto kShiftLeft = [](std::uint32_t a, std::uint32_t b) { return a << (b & 31U); };
constexpr auto kShiftRight = [](std::uint32_t a, std::uint32_t b) { return a >> (b & 31U); };
constexpr auto kShiftSigned = [](auto a, auto b) { return to_signed(a) >> (to_unsigned(b) & 31U); };

constexpr Row kRows[] = {
    {spv::OpSNegate, "SNegate", Kind::integer, "i:i",
     kWhole1<[](auto a) { return to_signed(0U - to_unsigned(a)); }>},
    {spv::OpIAdd, "IAdd", Kind::integer, "i:ii", kWhole2<kUnsigned2<[](auto a, auto b) { return a + b; }>>},
    {spv::OpISub, "ISub", Kind::integer, "i:ii", kWhole2<kUnsigned2<[](auto a, auto b) { return a - b; }>>},
    {spv::OpIMul, "IMul", Kind::integer, "i:ii", kWhole2<kUnsigned2<[](auto a, auto b) { return a * b; }>>},
    {spv::OpUDiv, "UDiv", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return divide(a, b); }>>},
    {spv::OpSDiv, "SDiv", Kind::integer, "i:ii",
     kWhole2<kSigned2<[](auto a, auto b) { return divide(a, b); }>>},
    {spv::OpUMod, "UMod", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return remainder(a, b); }>>},
    {spv::OpSRem, "SRem", Kind::integer, "i:ii",
     kWhole2<kSigned2<[](auto a, auto b) { return remainder(a, b); }>>},
    {spv::OpSMod, "SMod", Kind::integer, "i:ii",
     kWhole2<kSigned2<[](auto a, auto b) { return modulo(a, b); }>>},
    {spv::OpIAddCarry, "IAddCarry", Kind::integer, "", kTwoWords<kAddCarry>},
    {spv::OpISubBorrow, "ISubBorrow", Kind::integer, "", kTwoWords<kSubBorrow>},
    {spv::OpUMulExtended, "UMulExtended", Kind::integer, "", kTwoWords<kUnsignedProduct>},
    {spv::OpSMulExtended, "SMulExtended", Kind::integer, "", kTwoWords<kSignedProduct>},
    {spv::OpNot, "Not", Kind::integer, "i:i", kWhole1<[](auto a) { return to_signed(~to_unsigned(a)); }>},
    {spv::OpBitwiseAnd, "BitwiseAnd", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return a & b; }>>},
    {spv::OpBitwiseOr, "BitwiseOr", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return a | b; }>>},
    {spv::OpBitwiseXor, "BitwiseXor", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return a ^ b; }>>},
    {spv::OpShiftLeftLogical, "ShiftLeftLogical", Kind::integer, "i:ii", kWhole2<kUnsigned2<kShiftLeft>>},
    {spv::OpShiftRightLogical, "ShiftRightLogical", Kind::integer, "i:ii", kWhole2<kUnsigned2<kShiftRight>>},
    {spv::OpShiftRightArithmetic, "ShiftRightArithmetic", Kind::integer, "i:ii", kWhole2<kShiftSigned>},
    {spv::OpBitReverse, "BitReverse", Kind::integer, "i:i",
     kWhole1<[](auto a) { return to_signed(reverse_bits(to_unsigned(a))); }>},
    {spv::OpBitCount, "BitCount", Kind::integer, "i:i",
     kWhole1<[](auto a) { return std::popcount(to_unsigned(a)); }>},
    {spv::OpBitFieldUExtract,
     "BitFieldUExtract",
     Kind::integer,
     "i:iII",
     {&bit_field_extract<false, float>, &bit_field_extract<false, double>}},
    {spv::OpBitFieldSExtract,
     "BitFieldSExtract",
     Kind::integer,
     "i:iII",
     {&bit_field_extract<true, float>, &bit_field_extract<true, double>}},
    {spv::OpBitFieldInsert,
     "BitFieldInsert",
     Kind::integer,
     "i:iiII",
     {&bit_field_insert<float>, &bit_field_insert<double>}},
    {kExtended + GLSLstd450FindILsb, "FindILsb", Kind::integer, "i:i",
     kWhole1<[](auto a) { return lowest_bit(to_unsigned(a)); }>},
    {kExtended + GLSLstd450FindSMsb, "FindSMsb", Kind::integer, "i:i", kWhole1<[](auto a) {
         return highest_bit(to_unsigned(to_signed(a) < 0 ? ~to_signed(a) : to_signed(a)));
     }>},
    {kExtended + GLSLstd450FindUMsb, "FindUMsb", Kind::integer, "i:i",
     kWhole1<[](auto a) { return highest_bit(to_unsigned(a)); }>},
    {kExtended + GLSLstd450SAbs, "SAbs", Kind::integer, "i:i",
     kWhole1<[](auto a) { return to_signed(to_signed(a) < 0 ? 0U - to_unsigned(a) : to_unsigned(a)); }>},
    {kExtended + GLSLstd450SSign, "SSign", Kind::integer, "i:i",
     kWhole1<[](auto a) { return (to_signed(a) > 0) - (to_signed(a) < 0); }>},
    {kExtended + GLSLstd450UMin, "UMin", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return b < a ? b : a; }>>},
    {kExtended + GLSLstd450SMin, "SMin", Kind::integer, "i:ii",
     kWhole2<kSigned2<[](auto a, auto b) { return b < a ? b : a; }>>},
    {kExtended + GLSLstd450UMax, "UMax", Kind::integer, "i:ii",
     kWhole2<kUnsigned2<[](auto a, auto b) { return a < b ? b : a; }>>},
    {kExtended + GLSLstd450SMax, "SMax", Kind::integer, "i:ii",
     kWhole2<kSigned2<[](auto a, auto b) { return a < b ? b : a; }>>},
    {kExtended + GLSLstd450UClamp, "UClamp", Kind::integer, "i:iii", kWhole3<[](auto x, auto low, auto high) {
         const std::uint32_t raised = std::max(to_unsigned(x), to_unsigned(low));
         return to_signed(std::min(raised, to_unsigned(high)));
     }>},
    {kExtended + GLSLstd450SClamp, "SClamp", Kind::integer, "i:iii", kWhole3<[](auto x, auto low, auto high) {
         return std::min(std::max(to_signed(x), to_signed(low)), to_signed(high));
     }>},
};

}  // namespace

std::span<const Row> integer_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
