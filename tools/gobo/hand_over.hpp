// gobo becomes gobo-lab for what only the lab can do, as git and cargo do.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// Replaces this process by gobo-lab with the same arguments: the one beside this program, else the first in
/// PATH. Returns only where there is none or it cannot be run, with an error that says what to install;
/// `needs` says what asked for it ("gobo test").
[[nodiscard]] Diagnostics hand_over(const std::string& needs, const std::vector<std::string>& arguments);

/// Has the lab find what this program has read of standard input.
void keep_standard_input(const std::string& text);

}  // namespace gobo
