// Measures what an operation of each kind costs on a renderer.
#pragma once

#include "core/file_system.hpp"
#include "lab/study/timing.hpp"
#include "lab/study/weights.hpp"

namespace gobo::study {

/// One operation repeated: what it executes more, and how much longer that takes.
struct Weighing {
    std::string operation;
    std::array<double, evaluate::kKinds> counts{};  ///< of one fragment
    Spread nanoseconds;                             ///< of one fragment
};

struct WeighingResult {
    Weights weights;
    std::vector<Weighing> operations;
    Control control;
};

/// Draws the family data/study/operations of `shipped` with each operation a few times and many, and solves
/// for the prices. Errors: of the driver.
[[nodiscard]] Result<WeighingResult> weigh_operations(const FileSystem& shipped, const Context& context,
                                                      int rounds, int jobs);

/// The weights, none negative, that explain the measured times best: least squares, each row weighted by the
/// inverse of its time. In nanoseconds.
[[nodiscard]] std::array<double, evaluate::kKinds> solve_for_prices(const std::vector<Weighing>& operations);

}  // namespace gobo::study
