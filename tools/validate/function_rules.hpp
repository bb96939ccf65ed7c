// What a stage says of its functions that glslang takes and drivers refuse.
#pragma once

#include <string>

#include "core/diagnostic.hpp"
#include "validate/active_text.hpp"

namespace gobo {

/// Errors of the heads of functions, and of what stands within them and cannot. The prologue states version
/// and extensions.
[[nodiscard]] Diagnostics check_functions(const ActiveText& text, const std::string& prologue);

}  // namespace gobo
