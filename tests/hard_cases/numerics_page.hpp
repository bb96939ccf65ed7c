// docs/numerics.md: its tables, made from the cases, the guards and the plain shaders themselves.
#pragma once

#include <string>

#include "guard_prices.hpp"

namespace gobo {

/// The whole page. The times are given, since they differ from run to run; all else is computed.
[[nodiscard]] std::string numerics_page(const GuardTimes& times);

}  // namespace gobo
