// Options that take lists of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// The names in the values of an option that takes lists, as "--gpu navi21,vega10 --gpu ampere". An error
/// where one is empty.
[[nodiscard]] Result<std::vector<std::string>> names_in(std::string_view option,
                                                        const std::vector<std::string>& lists);

}  // namespace gobo
