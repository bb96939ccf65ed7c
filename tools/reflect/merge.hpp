// The interface of a program from its stages, and of a family from its permutations.
#pragma once

#include <vector>

#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// The interface of a program: inputs of its first stage, outputs of its last (as the pipeline runs, whatever
/// the order of `stages`), everything else united by name. Meant for stages that link, so where two declare
/// the same name their declarations agree; should they differ, the earlier stage's stands.
[[nodiscard]] Interface merge(std::vector<Interface> stages);
[[nodiscard]] Interface merge(const Interface& vertex, const Interface& fragment);

/// The interface that serves every one of several programs, the permutations of a family: lists united by
/// name. A block whose last member is an array may differ in that array's outermost extent: the largest is
/// kept. Where two programs disagree in any other way about a name: an error (Fault::input) that names it.
[[nodiscard]] Result<Interface> unite(const std::vector<Interface>& programs);

}  // namespace gobo
