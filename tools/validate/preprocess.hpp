// A stage's source as the preprocessor leaves it.
#pragma once

#include <optional>
#include <string>

#include "compose/composition.hpp"

namespace gobo {

/// The stage's pieces in one text, macros expanded, lines under false conditions gone: line for line as
/// source_of(). Nothing where glslang's preprocessor refuses it.
[[nodiscard]] std::optional<std::string> preprocessed(const Composition& composition, const Stage& stage);

}  // namespace gobo
