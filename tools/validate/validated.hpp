// What validating gives: SPIR-V and interface of every distinct stage, or the diagnostics.
#pragma once

#include <cstdint>
#include <vector>

#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A SPIR-V module, as words.
using SpirvModule = std::vector<std::uint32_t>;

/// One distinct stage after glslang.
struct ValidatedStage {
    SpirvModule spirv;    ///< empty unless asked for
    Interface interface;  ///< of this stage alone; a location or binding that the source does not state is -1
};

/// The stages in the order of Composition::stages.
struct Validated {
    std::vector<ValidatedStage> stages;
    Diagnostics
        diagnostics;  ///< errors and warnings, grouped over permutations; the stages of failed ones are empty
};

}  // namespace gobo
