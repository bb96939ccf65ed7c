// Every operation of every stage of a composition on hard inputs.
#pragma once

#include <cstdint>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "core/result_cache.hpp"
#include "family/family.hpp"
#include "lab/sanitize/finding.hpp"
#include "validate/validate.hpp"

namespace gobo::sanitize {

struct SanitizeOptions {
    int jobs = 1;               ///< threads
    std::size_t points = 2048;  ///< hard inputs of each distinct stage
    std::size_t total = 0;      ///< where above 0: at least so many over all stages, instead
    std::uint64_t seed = 1;
    /// Each point is run on all of them.
    std::vector<Machine> machines = {Machine::ieee, Machine::flushed};
    std::size_t guided = 0;  ///< points of each stage that are made of what earlier ones reached
    double minutes = 0;      ///< goes on with such points until so long has passed
    /// Where what is found at a stage is kept from one run to the next; null, or with `minutes`: nowhere.
    ResultCache* cache = nullptr;
};

/// A finding, once per place, with all that share it.
struct SharedFinding {
    Finding finding;                        ///< at an input made simple
    std::size_t stage = 0;                  ///< it is of: index into Composition::stages
    std::vector<std::size_t> permutations;  ///< indices into Composition::permutations
};

struct SanitizeReport {
    std::vector<SharedFinding> findings;  ///< by place and message
    Diagnostics diagnostics;              ///< why a stage could not be evaluated
    std::size_t stages = 0;
    std::uint64_t points = 0;  ///< over all stages, each run on every machine
};

/// `validated` must hold the SPIR-V of every stage, with debug information, so that places are known. Without
/// `minutes` the same options give the same report.
[[nodiscard]] SanitizeReport sanitize(const Family& family, const Composition& composition,
                                      const Validated& validated, const SanitizeOptions& options);

/// An error at each of the domains that no stage reads anything of. Constraints may name what `known` holds,
/// too.
[[nodiscard]] Diagnostics domains_of_nothing(const std::vector<Domain>& domains,
                                             const std::vector<Domain>& known, const Validated& validated);

/// The permutations that share the stage, as indices.
[[nodiscard]] std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage);

}  // namespace gobo::sanitize
