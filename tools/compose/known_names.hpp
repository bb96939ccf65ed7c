// Whether what a family file names stands in its shaders.
#pragma once

#include "compose/composition.hpp"
#include "compose/search_path.hpp"

namespace gobo {

/// An error for each name under [domain], [render], [[relations]] and [[descriptor_sets]] of the family's own
/// file that no key's shaders mention. Files that no key of `composition` has are read only for names that it
/// lacks.
[[nodiscard]] Diagnostics unknown_names(const Family& family, const SearchPath& search,
                                        const Composition& composition);

}  // namespace gobo
