// What the textures of a stage hold for samples of `lit`: opacity, environments, shadow maps.
#pragma once

#include <span>

#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// Gives every sampler that samples know what it holds: each invocation sees the textures of its own sample.
void feed_textures(const evaluate::Program& program, std::span<const Sample> samples,
                   evaluate::Invocations& invocations);

/// Takes into the sample what the textures of the first invocation hold. False where one is not given, or
/// samples do not know it.
[[nodiscard]] bool read_textures(const evaluate::Program& program, const evaluate::Invocations& invocations,
                                 Sample& sample);

}  // namespace gobo::verify
