// How much of its outputs a stage loses to single precision, and which operations lose it; as a table and as
// JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/sanitize/sanitize.hpp"

namespace gobo::sanitize {

/// What the roundings of one operation do to an output, all other operations being exact.
struct Contribution {
    Place place;
    std::string operation;  ///< "FMul"
    double change = 0;      ///< of the output's component, absolute
};

/// The largest loss of one output that was met.
struct OutputLoss {
    std::string output;
    std::uint32_t component = 0;
    double fp32 = 0;
    double fp64 = 0;
    /// |fp32 - fp64| / max(1, |fp64| of the largest component): absolute up to 1, relative above. Infinite
    /// where fp32 is not finite.
    double error = 0;
    Point point;
    std::vector<Contribution> contributions;  ///< largest first; those of a place and operation are one
    double all_contributions = 0;             ///< sum of their changes
};

struct PrecisionReport {
    std::vector<OutputLoss> outputs;  ///< in the program's order; those that never differ are left out
    std::uint64_t points = 0;
    std::uint64_t decided_otherwise = 0;  ///< of them, left out: fp32 took another side of a comparison
};

/// Half of the points are hard ones, the others steps from the worst. The same arguments give the same
/// report.
[[nodiscard]] Result<PrecisionReport> measure_precision(const evaluate::Program& program,
                                                        const InputSpace& space, std::size_t points,
                                                        std::uint64_t seed);

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
