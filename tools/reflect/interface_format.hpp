// An interface written out: JSON for programs, text for people.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "reflect/interface.hpp"

namespace gobo {

/// The JSON of `gobo reflect --json`: "stages", "blocks", "uniforms", "samplers", "inputs", "outputs", always
/// all of them. What few programs have is there only for those: "storage_blocks", which look like blocks, and
/// "array" of an input or output. Unknown bindings and locations are -1.
[[nodiscard]] nlohmann::ordered_json to_json(const Interface& interface);

/// Aligned columns, one line a member, ending in a newline; lists that are empty are left out.
[[nodiscard]] std::string to_text(const Interface& interface);

}  // namespace gobo
