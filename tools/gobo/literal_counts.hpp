// Counts that a family wants as specialisation constants, where the shaders take them as numbers alone.
#pragma once

#include "compose/composition.hpp"
#include "gobo/input.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// Validates a composition. Where keys have errors that they do not have with numbers in the place of
/// constants, such as at `case LAMPS:`, it is composed anew with numbers there, and its notes say why.
[[nodiscard]] Validated validate_with_counts(const LoadedFamily& family, Composition& composition,
                                             const ValidateOptions& options);

/// Errors where a constant of the shaders' own has the constant_id of a count, even where the key's counts
/// are numbers: in the other keys' stages they are not.
[[nodiscard]] Diagnostics clashes_with_counts(const LoadedFamily& family, const Composition& composition,
                                              const Validated& validated);

}  // namespace gobo
