// Inputs that keep a shader's contract: what they have to do with one another, beside the range of each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "family/constraint.hpp"

namespace gobo::sanitize {

struct InputSpace;

/// Takes from the range of an input of that name, without subscripts, or of one of its components, what
/// comparisons with numbers exclude. Whether there are such comparisons.
bool narrow(Domain& domain, const std::string& name, std::optional<std::size_t> component, bool is_float,
            const std::vector<Constraint>& constraints);

/// One of the space's comparisons that no input keeps, given its range and the other comparisons.
[[nodiscard]] const Constraint* contradiction_in(const InputSpace& space);

/// Changes the point as little as it takes for its inputs to keep the space's constraints.
void constrain(const InputSpace& space, std::span<double> point);

}  // namespace gobo::sanitize
