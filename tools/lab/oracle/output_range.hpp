// What a target can hold of a radiance.
#pragma once

#include <glm/vec3.hpp>

#include "lab/oracle/model.hpp"

namespace gobo::oracle {

/// The radiance, at most the largest number of the target: 65504 of IEEE 754 binary16, 1 of a display.
[[nodiscard]] glm::dvec3 within_range(OutputRange range, const glm::dvec3& radiance);

}  // namespace gobo::oracle
