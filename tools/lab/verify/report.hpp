// What a verification found: figures, and points where a stage gives something else than it should.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/evaluate/eval_file.hpp"

namespace gobo::verify {

enum class Precision { fp32, fp64 };

/// "fp32" or "fp64".
[[nodiscard]] std::string_view name_of(Precision precision);

/// Of an error to its limit; infinite for a NaN.
[[nodiscard]] double ratio_of(double error, double limit);

/// A point where an output is out of tolerance: its worst component.
struct Failure {
    StageKind stage = StageKind::vertex;
    Precision precision = Precision::fp32;
    std::string output;
    std::uint32_t component = 0;
    double expected = 0;
    double actual = 0;
    double tolerance = 0;
    double ratio = 0;  ///< of the error to the tolerance; infinite for a NaN
    evaluate::EvalPoint point;
};

/// What is counted, of a stage, a permutation or a whole run.
struct Figures {
    std::size_t points = 0;         ///< invocations, each evaluated as fp32 and as fp64
    std::size_t edges = 0;          ///< of them, so near a discontinuity that either side is right
    double largest_fp64_error = 0;  ///< relative to the largest term
    double largest_fp32_error = 0;  ///< as well; without an oracle, to the output's largest component
    double largest_fp32_ratio = 0;  ///< of the error to its derived bound
    std::size_t vacuous = 0;  ///< points where some output's bound is above its value, and so says little
    std::size_t loose = 0;    ///< of them, those with a bound of more than kLooseBound of the largest term
    std::size_t unexplained = 0;  ///< points where floats err by more than roundings of the inputs explain

    Figures& operator+=(const Figures& other);
};

inline constexpr std::size_t kWorstPoints = 3;
inline constexpr double kLooseBound = 0.01;

/// Of a stage.
struct StageReport {
    Figures figures;
    std::size_t failed_points = 0;
    std::vector<Failure> worst;  ///< at most kWorstPoints, largest ratio first
    /// The point, of Figures::unexplained, that is furthest from what its inputs explain, `tolerance`.
    std::optional<Failure> least_explained;

    /// Keeps the failure if it is among so many worst.
    void add(Failure failure, std::size_t most = kWorstPoints);
    /// Adds up figures and points, and keeps so many worst.
    void add(StageReport other, std::size_t most = kWorstPoints);
};

/// The failing point as an input file of `gobo eval`, numbers in full precision. `key` is the permutation's
/// text.
[[nodiscard]] std::string eval_input(const Failure& failure, const std::string& key);

/// "fp32 fragmentColor[0] is 0.25, should be 0.5 within 1e-06".
[[nodiscard]] std::string to_text(const Failure& failure);

}  // namespace gobo::verify
