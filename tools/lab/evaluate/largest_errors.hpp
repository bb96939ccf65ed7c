// The largest errors that a machine may make by the specification. Internal to evaluation.
#pragma once

#include "lab/evaluate/machine.hpp"

namespace gobo::evaluate {

/// Whether the specification lets the operation of this code be off by more than its rounding, and evaluation
/// can add that: pow, exp, exp2, log, log2, inversesqrt.
[[nodiscard]] bool has_largest_error(std::uint32_t code);

/// Moves the operation's result by the largest error allowed, up or down. Vulkan 1.3, Precision of Individual
/// Operations, which OpenGL's drivers follow (GLSL 4.50, 4.7.1, leaves them open): exp2 3 + 2 |x| ulp, log2
/// 3 ulp, within [0.5, 2] an absolute 2^-21, inversesqrt 2 ulp, pow what exp2(y log2(x)) adds up to.
template <class T>
void add_largest_error(std::uint32_t code, const Operation& operation, Machine<T>& machine, bool upward);

}  // namespace gobo::evaluate
