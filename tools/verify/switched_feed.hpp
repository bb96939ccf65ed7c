// What the ubershader reads of a sample, where it does what the sample's model says.
#pragma once

#include <optional>
#include <string>

#include "verify/feed.hpp"

namespace gobo::verify {

/// The field of that reflected name in the blocks that only the ubershader has: "Switches.diffuse",
/// "SwitchedLights.lights[3].shadow.layer", "LoopedLights.spot[0].axis", "Toon.tones". Lights stand in the
/// order directional, point, spot, homogeneous; lights beyond them are switched off. Such fields are read,
/// not set: no sample is made of what an ubershader was given.
[[nodiscard]] std::optional<Field> switched_field(const std::string& name);

}  // namespace gobo::verify
