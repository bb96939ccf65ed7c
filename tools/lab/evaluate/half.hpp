// 16-bit floats: their bits, and the nearest one to a number.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gobo::evaluate {

struct Half {
    static constexpr std::uint32_t kBits = 16;

    /// The nearest number of half precision, ties to even; too large ones become infinity.
    static std::uint32_t pack(double value) {
        const std::uint32_t sign = std::signbit(value) ? 0x8000U : 0U;
        const double size = std::fabs(value);
        if (std::isnan(value)) return sign | 0x7e00U;
        if (size >= 65520.0) return sign | 0x7c00U;
        // Below 2^-14 the spacing stays at 2^-24. A carry out of the significand raises the exponent by
        // itself.
        if (size < std::ldexp(1.0, -14))
            return sign | static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 24)));
        const int exponent = std::ilogb(size);
        const auto significand = static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent)));
        return sign | ((static_cast<std::uint32_t>(exponent + 15) << 10U) + significand - 1024U);
    }

    static double unpack(std::uint32_t half) {
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
};

/// What becomes of numbers below 2^-14, of which a 16-bit float does not keep all 11 bits.
enum class SmallHalves {
    gradual,  ///< they are spaced by 2^-24
    flushed,  ///< they are 0, as GLSL ES allows
    kept,     ///< they have 11 bits, as in no hardware: to compare with
};

/// The nearest 16-bit float; beyond 65,504 an infinity.
inline float rounded_to_half(float number, SmallHalves small = SmallHalves::gradual) {
    const float size = std::fabs(number);
    if (!(size > 0) || std::isinf(size)) return number;
    if (size >= 65520.0F) return std::copysign(std::numeric_limits<float>::infinity(), number);
    // Numbers are spaced by 2^-10 of the power of two below them, the smallest by 2^-24; where they are kept,
    // by the smallest normal float.
    const int least = small == SmallHalves::kept ? -116 : -14;
    const int exponent = std::max(static_cast<int>(std::bit_cast<std::uint32_t>(size) >> 23U) - 127, least);
    const float spacing = std::bit_cast<float>(static_cast<std::uint32_t>(exponent - 10 + 127) << 23U);
    const float rounded = std::nearbyint(number / spacing) * spacing;
    const bool is_flushed = small == SmallHalves::flushed && std::fabs(rounded) < 0x1p-14F;
    return is_flushed ? std::copysign(0.0F, number) : rounded;
}

}  // namespace gobo::evaluate
