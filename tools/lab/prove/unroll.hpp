// A decoded stage as expressions.
#pragma once

#include "core/diagnostic.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/prove/expression.hpp"

namespace gobo::prove {

/// Runs the stage once with expressions instead of numbers: loops are unrolled as long as inputs may stay in
/// them, ways apart are joined where they meet. Errors: a loop that does not come to an end after so many
/// turns, or too long a list.
[[nodiscard]] Result<Expressions> unroll(const evaluate::Program& program, const sanitize::InputSpace& space,
                                         bool has_tiny_inputs);

}  // namespace gobo::prove
