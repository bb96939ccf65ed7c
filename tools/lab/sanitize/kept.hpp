// What the cache keeps of searches and proofs, field by field.
#pragma once

#include "core/bytes.hpp"
#include "lab/sanitize/finding.hpp"

namespace gobo {

void fields(auto& archive, OneOf<Domain> auto& value) {
    auto& [name, low, high, of_length, last, also, place] = value;
    archive(name, low, high, of_length, last, also, place);
}

namespace evaluate {

void fields(auto& archive, OneOf<EvalPoint> auto& value) {
    auto& [inputs, uniforms, samplers, pixel, machine] = value;
    archive(inputs, uniforms, samplers, pixel, machine);
}

}  // namespace evaluate

namespace sanitize {

void fields(auto& archive, OneOf<Consequence> auto& value) {
    auto& [place, message, operation] = value;
    archive(place, message, operation);
}
void fields(auto& archive, OneOf<Finding> auto& value) {
    auto& [stage, place, message, operation, machine, point, points, consequences, is_of_constants, follows] =
        value;
    archive(stage, place, message, operation, machine, point, points, consequences, is_of_constants, follows);
}

}  // namespace sanitize
}  // namespace gobo
