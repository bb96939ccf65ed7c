// What the lighting models of `lit` allow their outputs to be.
#pragma once

#include "lab/sanitize/output_bounds.hpp"

namespace gobo::sanitize {

/// Null where the oracle does not know the key's model or what the stage reads.
[[nodiscard]] std::unique_ptr<ModelBounds> lit_bounds(const Family& family, const Key& key, StageKind stage,
                                                      const evaluate::Program& program,
                                                      const InputSpace& space);

}  // namespace gobo::sanitize
