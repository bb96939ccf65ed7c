// Conversions between reals and integers, and reinterpretations of their bits.
#include <bit>
#include <cmath>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// Truncated; what does not fit becomes the nearest that does, NaN becomes 0 (GLSL leaves both undefined).
template <class Integer, class T>
std::int32_t saturate(T value) {
    const double wide = static_cast<double>(value);
    if (std::isnan(wide)) return 0;
    if (wide <= static_cast<double>(std::numeric_limits<Integer>::min()))
        return static_cast<std::int32_t>(std::numeric_limits<Integer>::min());
    if (wide >= static_cast<double>(std::numeric_limits<Integer>::max()))
        return static_cast<std::int32_t>(std::numeric_limits<Integer>::max());
    return static_cast<std::int32_t>(static_cast<Integer>(wide));
}

/// Reals have the bits of the nearest fp32 value, in either arithmetic.
template <class T>
std::int32_t bits_of(T value) {
    return std::bit_cast<std::int32_t>(static_cast<float>(value));
}
template <class W>
float real_of(W bits) {
    return std::bit_cast<float>(to_signed(bits));
}

constexpr Execution kSame = kWhole1<[](auto a) { return a; }>;

constexpr Row kRows[] = {
    {spv::OpConvertFToS, "ConvertFToS", Kind::convert, "i:f",
     kTest1<[](auto a) { return saturate<std::int32_t>(a); }>},
    {spv::OpConvertFToU, "ConvertFToU", Kind::convert, "i:f",
     kTest1<[](auto a) { return saturate<std::uint32_t>(a); }>},
    {spv::OpConvertSToF, "ConvertSToF", Kind::convert, "f:i",
     kMap1<[](auto a) { return to_signed(a); }, RealRows, WholeRows>},
    {spv::OpConvertUToF, "ConvertUToF", Kind::convert, "f:i",
     kMap1<[](auto a) { return to_unsigned(a); }, RealRows, WholeRows>},
    {spv::OpBitcast, "Bitcast", Kind::convert, "i:f", kTest1<[](auto a) { return bits_of(a); }>},
    {spv::OpBitcast, "Bitcast", Kind::convert, "f:i",
     kMap1<[](auto a) { return real_of(a); }, RealRows, WholeRows>},
    {spv::OpBitcast, "Bitcast", Kind::convert, "i:i", kSame},
    {spv::OpUConvert, "UConvert", Kind::convert, "i:i", kSame},
    {spv::OpSConvert, "SConvert", Kind::convert, "i:i", kSame},
};

}  // namespace

std::span<const Row> conversion_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
