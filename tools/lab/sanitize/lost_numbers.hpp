// Numbers too small for 16-bit floats, where an output is another one without them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

inline constexpr std::string_view kLostNumber = "a number too small for a 16-bit float is lost";

/// An operation that lost one.
struct LostNumber {
    std::uint32_t operation = 0;  ///< of a constant, the first that reads it
    std::size_t invocation = 0;   ///< the first that shows it
    std::uint64_t points = 0;
    std::string text;  ///< "FMul x = 1e-05, x = 1e-05 -> 0, so that c is 0, not 1"
};

/// Compares `outputs`, which the invocations gave in the 16-bit arithmetic of `options`, with those of the
/// same arithmetic whose small numbers keep their 11 bits. Where they differ by more than a step of an 8-bit
/// colour (above 1, by more than that part) and by more than twice what inputs moved by their own roundings
/// make, the first operation is named with which most of the difference is there. Invocations that
/// `is_judged` refuses are left out. Each operation is given once.
[[nodiscard]] Result<std::vector<LostNumber>> find_lost_numbers(
    const evaluate::Program& program, const evaluate::Invocations& invocations,
    const evaluate::Options& options, const evaluate::Outputs& outputs,
    const std::function<bool(std::size_t invocation)>& is_judged);

}  // namespace gobo::sanitize
