// Whether what a family's descriptor sets hold stands in its shaders.
#pragma once

#include <string_view>

#include "compose/composition.hpp"
#include "compose/search_path.hpp"

namespace gobo {

/// An error for each name under [[descriptor_sets]] of the family's own file that is no block, sampler or
/// image of any key's shaders. Files that no key of `composition` has are read only for names that it lacks.
[[nodiscard]] Diagnostics unknown_set_names(const Family& family, const SearchPath& search,
                                            const Composition& composition);

/// Whether a text joins names by ##, but by the macros of gobo's prologues.
[[nodiscard]] bool joins_names(std::string_view text);

}  // namespace gobo
