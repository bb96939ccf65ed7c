// From the text of a family file to a Family.
#pragma once

#include <string>
#include <string_view>

#include "family/family.hpp"

namespace gobo {

/// Reads a family file (docs/family_file.md describes it). `path` stands in diagnostics and decides the
/// folder of the templates. Anything unknown, missing or of the wrong type is an error with its place.
[[nodiscard]] Result<Family> read_family(std::string_view text, const std::string& path);

}  // namespace gobo
