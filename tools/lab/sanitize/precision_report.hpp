// Where precision is lost, as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/sanitize/precision.hpp"
#include "lab/sanitize/sanitize.hpp"

namespace gobo::sanitize {

/// What a stage loses, and the keys that share it.
struct StagePrecision {
    StageKind stage = StageKind::vertex;
    std::vector<std::string> keys;
    PrecisionReport report;
};

/// Measures every distinct stage at `options.points` points from `options.seed` on.
[[nodiscard]] Result<std::vector<StagePrecision>> measure_precision(const Family& family,
                                                                    const Composition& composition,
                                                                    const Validated& validated,
                                                                    const SanitizeOptions& options);

/// One line for each output of each stage, the largest error first, then how many points were tried.
[[nodiscard]] std::string precision_text(const std::vector<StagePrecision>& stages);

/// The same with every contribution, and the inputs.
[[nodiscard]] std::string precision_json(const std::vector<StagePrecision>& stages);

}  // namespace gobo::sanitize
