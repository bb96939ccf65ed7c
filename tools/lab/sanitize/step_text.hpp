// One operation in one lane, in words.
#pragma once

#include <cstddef>
#include <string>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

/// "FDiv 1, depth = 0"; to be asked while the operands stand ready.
[[nodiscard]] std::string operands_text(const evaluate::Step<float>& step, std::size_t lane);

/// "inf", "color = (1, 0.5, 0.25)".
[[nodiscard]] std::string result_text(const evaluate::Step<float>& step, std::size_t lane);

/// "FDiv 1, depth = 0 -> inf".
[[nodiscard]] std::string operation_text(const evaluate::Step<float>& step, std::size_t lane);

}  // namespace gobo::sanitize
