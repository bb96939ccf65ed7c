// Every distinct stage through glslang once, every distinct pair linked.
#pragma once

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "validate/validated.hpp"

namespace gobo {

struct ValidateOptions {
    int jobs = 1;  ///< threads
    bool keep_spirv = false;
    bool debug_information =
        false;  ///< OpSource and OpLine in the SPIR-V: which piece and line an operation comes from
    bool spirv_val = false;  ///< also ask SPIRV-Tools' validator
};

/// Validates a composition. What several permutations share is reported once, with how many there are; errors
/// come in the order of the permutations, whatever the number of jobs.
[[nodiscard]] Validated validate(const Family& family, const Composition& composition,
                                 const ValidateOptions& options);

/// The interface of a permutation's two stages as one program.
[[nodiscard]] Interface interface_of(const Validated& validated, const Permutation& permutation);

}  // namespace gobo
