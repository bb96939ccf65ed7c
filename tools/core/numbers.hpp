// Small functions of numbers.
#pragma once

#include <cmath>
#include <limits>

namespace gobo {

/// The float nearest to a number; infinite beyond the largest.
[[nodiscard]] inline double nearest_float(double number) {
    return static_cast<double>(static_cast<float>(number));
}
/// The float next to a number, which need not be one.
[[nodiscard]] inline double float_above(double number) {
    return static_cast<double>(
        std::nextafter(static_cast<float>(number), std::numeric_limits<float>::infinity()));
}
[[nodiscard]] inline double float_below(double number) {
    return -float_above(-number);
}

/// The next multiple, or the number where it is one: offsets and sizes by an alignment.
template <class Integer>
[[nodiscard]] constexpr Integer rounded_up(Integer number, Integer multiple) {
    return (number + multiple - 1) / multiple * multiple;
}

}  // namespace gobo
