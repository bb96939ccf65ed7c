// Matches what the caller gives to what the stage reads. Internal to evaluation.
#pragma once

#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// The values of one input or uniform.
struct Binding {
    const Port* port = nullptr;
    std::vector<double> values;
    bool is_per_invocation = false;  ///< otherwise the same for all
};

/// Bindings in the order in which they overrule one another. Errors: names that the stage does not have, and
/// wrong numbers of values.
[[nodiscard]] Result<std::vector<Binding>> bind(const Program& program, const Invocations& invocations);

/// The double that the shortest decimal of a float stands for: 0.1f is 0.1.
[[nodiscard]] double shortest_decimal(float value);

}  // namespace gobo::evaluate
