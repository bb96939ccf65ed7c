// Hands samples of `lit` to a stage, by the reflected names of what it reads.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/diagnostic.hpp"
#include "evaluate/evaluate.hpp"
#include "verify/sample.hpp"

namespace gobo::verify {

/// The value of "PointLights.lights[2].color" in a sample, component by component, matrices column by column.
using Getter = std::function<std::vector<double>(const Sample&)>;

/// Empty where a sample has nothing of that name.
[[nodiscard]] Getter getter_of(const std::string& name);

/// The samples as invocations of the stage. An error for an input or uniform that samples have no value for.
[[nodiscard]] Result<evaluate::Invocations> feed(const evaluate::Program& program,
                                                 std::span<const Sample> samples);

}  // namespace gobo::verify
