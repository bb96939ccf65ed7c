// What the cache keeps of searches and proofs, field by field.
#pragma once

#include "core/bytes.hpp"
#include "lab/sanitize/finding.hpp"

namespace gobo {

GOBO_FIELDS(Domain, name, low, high, of_length, last, also, place)

namespace evaluate {

GOBO_FIELDS(EvalPoint, inputs, uniforms, samplers, pixel, machine)

}  // namespace evaluate

namespace sanitize {

GOBO_FIELDS(Consequence, place, message, operation)
GOBO_FIELDS(Finding, stage, place, message, operation, machine, point, points, consequences, is_of_constants,
            follows)

}  // namespace sanitize
}  // namespace gobo
