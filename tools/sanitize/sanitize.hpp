// Every operation of every stage of a composition on hard inputs.
#pragma once

#include <cstdint>
#include <vector>

#include "common/diagnostic.hpp"
#include "compose/composition.hpp"
#include "family/family.hpp"
#include "sanitize/finding.hpp"
#include "validate/validated.hpp"

namespace gobo::sanitize {

struct SanitizeOptions {
    int jobs = 1;               ///< threads
    std::size_t points = 2048;  ///< hard inputs of each distinct stage
    std::uint64_t seed = 1;
    /// Each point is run on all of them.
    std::vector<Machine> machines = {Machine::ieee, Machine::flushed};
    double minutes = 0;  ///< goes on with fresh points until so long has passed
};

/// A finding, once per place, with all that share it.
struct SharedFinding {
    Finding finding;
    std::vector<std::size_t> permutations;  ///< indices into Composition::permutations
};

struct SanitizeReport {
    std::vector<SharedFinding> findings;  ///< by place and message
    Diagnostics diagnostics;              ///< why a stage could not be evaluated
    std::size_t stages = 0;
    std::uint64_t points = 0;  ///< invocations that were watched, over all stages and machines
};

/// `validated` must hold the SPIR-V of every stage, with debug information, so that places are known. Without
/// `minutes` the same options give the same report.
[[nodiscard]] SanitizeReport sanitize(const Family& family, const Composition& composition,
                                      const Validated& validated, const SanitizeOptions& options);

/// The traps of one stage at the given points; the stage's kind is left to the caller. An output that nothing
/// ever stores to has no place.
[[nodiscard]] Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                                      const evaluate::Invocations& invocations,
                                                      Machine machine);

}  // namespace gobo::sanitize
