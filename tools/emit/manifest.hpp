// The manifest beside a generated header: what was built, for programs that are not C++.
#pragma once

#include <string>

#include "emit/header.hpp"

namespace gobo {

/// JSON: "family", "dialect", "features" (name, role, kind, values; the first value is the default),
/// "interface" (as `gobo reflect --json`, with the bindings and locations of the header), "stages" (each
/// distinct one: its kind and the names of its pieces in order) and "permutations" (key text, and the stages
/// by their number; where a budget chose it, "promised_error", "measured_error", "cost" and "chosen_by"),
/// sorted by key text. One stage or permutation a line. The same input gives the same bytes.
[[nodiscard]] std::string emit_manifest(const EmitInput& input);

}  // namespace gobo
