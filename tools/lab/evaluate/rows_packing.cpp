// GLSL.std.450: packing of reals into integers, as the GLSL specification, 8.4, rounds and clamps them.
#include <algorithm>
#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// The half-precision number nearest to `value`, ties to even; too large ones become infinity.
std::uint32_t to_half(double value) {
    const std::uint32_t sign = std::signbit(value) ? 0x8000U : 0U;
    const double size = std::fabs(value);
    if (std::isnan(value)) return sign | 0x7e00U;
    if (size >= 65520.0) return sign | 0x7c00U;
    // Below 2^-14 the spacing stays at 2^-24. A carry out of the significand raises the exponent by itself.
    if (size < std::ldexp(1.0, -14))
        return sign | static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 24)));
    const int exponent = std::ilogb(size);
    const auto significand = static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent)));
    return sign | ((static_cast<std::uint32_t>(exponent + 15) << 10U) + significand - 1024U);
}

double from_half(std::uint32_t half) {
    const int exponent = static_cast<int>(half >> 10U & 31U);
    const double significand = half & 1023U;
    double size = 0;
    if (exponent == 31)
        size = significand == 0 ? std::numeric_limits<double>::infinity() : std::nan("");
    else if (exponent == 0)
        size = std::ldexp(significand, -24);
    else
        size = std::ldexp(significand + 1024.0, exponent - 25);
    return (half & 0x8000U) != 0 ? -size : size;
}

/// A format of packed numbers: how many bits each has, and how one is read and written.
struct Unorm8 {
    static constexpr std::uint32_t kBits = 8;
    static std::uint32_t pack(double x) {
        return static_cast<std::uint32_t>(std::round(std::clamp(x, 0.0, 1.0) * 255.0));
    }
    static double unpack(std::uint32_t field) { return field / 255.0; }
};
struct Snorm8 {
    static constexpr std::uint32_t kBits = 8;
    static std::uint32_t pack(double x) {
        return static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::round(std::clamp(x, -1.0, 1.0) * 127.0)));
    }
    static double unpack(std::uint32_t field) {
        return std::clamp(static_cast<std::int8_t>(field) / 127.0, -1.0, 1.0);
    }
};
struct Unorm16 {
    static constexpr std::uint32_t kBits = 16;
    static std::uint32_t pack(double x) {
        return static_cast<std::uint32_t>(std::round(std::clamp(x, 0.0, 1.0) * 65535.0));
    }
    static double unpack(std::uint32_t field) { return field / 65535.0; }
};
struct Snorm16 {
    static constexpr std::uint32_t kBits = 16;
    static std::uint32_t pack(double x) {
        return static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::round(std::clamp(x, -1.0, 1.0) * 32767.0)));
    }
    static double unpack(std::uint32_t field) {
        return std::clamp(static_cast<std::int16_t>(field) / 32767.0, -1.0, 1.0);
    }
};
struct Half16 {
    static constexpr std::uint32_t kBits = 16;
    static std::uint32_t pack(double x) { return to_half(x); }
    static double unpack(std::uint32_t field) { return from_half(field); }
};

template <class Format>
constexpr std::uint32_t kMask = (1U << Format::kBits) - 1U;

template <class Format, class T>
void pack(const Operation& operation, Machine<T>& machine) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        std::uint32_t packed = 0;
        for (std::uint32_t component = 0; component < 32 / Format::kBits; ++component) {
            const double value = static_cast<double>(machine.reals(operation.operands[0] + component)[lane]);
            // NaN has no place in the normalised formats; a conversion of it would be undefined here too.
            const bool to_zero = std::isnan(value) && !std::is_same_v<Format, Half16>;
            packed |= (Format::pack(to_zero ? 0.0 : value) & kMask<Format>) << (component * Format::kBits);
        }
        machine.wholes(operation.result)[lane] = to_signed(packed);
    }
}

template <class Format, class T>
void unpack(const Operation& operation, Machine<T>& machine) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t packed = to_unsigned(machine.wholes(operation.operands[0])[lane]);
        for (std::uint32_t component = 0; component < 32 / Format::kBits; ++component)
            machine.reals(operation.result + component)[lane] =
                static_cast<T>(Format::unpack(packed >> (component * Format::kBits) & kMask<Format>));
    }
}

template <class Format>
inline constexpr Execution kPack{&pack<Format, float>, &pack<Format, double>};
template <class Format>
inline constexpr Execution kUnpack{&unpack<Format, float>, &unpack<Format, double>};

constexpr Row kRows[] = {
    {kExtended + GLSLstd450PackSnorm4x8, "PackSnorm4x8", Kind::convert, "I:f4", kPack<Snorm8>},
    {kExtended + GLSLstd450PackUnorm4x8, "PackUnorm4x8", Kind::convert, "I:f4", kPack<Unorm8>},
    {kExtended + GLSLstd450PackSnorm2x16, "PackSnorm2x16", Kind::convert, "I:f2", kPack<Snorm16>},
    {kExtended + GLSLstd450PackUnorm2x16, "PackUnorm2x16", Kind::convert, "I:f2", kPack<Unorm16>},
    {kExtended + GLSLstd450PackHalf2x16, "PackHalf2x16", Kind::convert, "I:f2", kPack<Half16>},
    {kExtended + GLSLstd450UnpackSnorm4x8, "UnpackSnorm4x8", Kind::convert, "f:I4", kUnpack<Snorm8>},
    {kExtended + GLSLstd450UnpackUnorm4x8, "UnpackUnorm4x8", Kind::convert, "f:I4", kUnpack<Unorm8>},
    {kExtended + GLSLstd450UnpackSnorm2x16, "UnpackSnorm2x16", Kind::convert, "f:I2", kUnpack<Snorm16>},
    {kExtended + GLSLstd450UnpackUnorm2x16, "UnpackUnorm2x16", Kind::convert, "f:I2", kUnpack<Unorm16>},
    {kExtended + GLSLstd450UnpackHalf2x16, "UnpackHalf2x16", Kind::convert, "f:I2", kUnpack<Half16>},
};

}  // namespace

std::span<const Row> packing_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
