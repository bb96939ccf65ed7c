// Which value every uniform gets: from the family's [render] table, from the object, or by its name.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "lab/render/source.hpp"
#include "lab/render/uniform_value.hpp"

namespace gobo {

/// The values of one object's uniforms, and warnings for those that have none and stay 0.
struct ResolvedUniforms {
    std::vector<Assignment> assignments;
    Diagnostics warnings;
};

/// A later value overrides an earlier one, and any of them what the name's usual spelling tells (see
/// uniform_source_of()). A value for a block or uniform that the interface lacks, or for an element beyond
/// its array, is left out: a family's table serves all of its permutations. Errors (Fault::input, at the
/// value's place): a member that a block does not have, an unknown source, numbers that do not fit the type.
[[nodiscard]] Result<ResolvedUniforms> resolve_uniforms(const Interface& interface,
                                                        const std::vector<RenderValue>& values,
                                                        const ViewedObject& object);

}  // namespace gobo
