// What the ubershader reads where it does what a model of `lit` says.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lab/oracle/model.hpp"

namespace gobo::verify {

/// Where one of its inputs or uniforms gets its value: from what `lit` reads by that name, else a number.
struct UberPort {
    std::string lit_name;
    double number = 0;
};

/// Of a reflected name in the blocks that the ubershader has and `lit` has not, or not so:
/// "Switches.diffuse", "SwitchedLights.lights[3].shadow.layer", "LoopedLights.spot[0].axis", "Toon.tones",
/// "Materials.rows[0].diffuse" where the model has one material. Lights stand in the order directional,
/// point, spot, homogeneous; lights beyond them are switched off, and what a light does not have is 0.
/// Nothing for names that mean the same in both.
[[nodiscard]] std::optional<UberPort> uber_port(const oracle::Model& model, std::string_view name);

/// Whether the name is of one of those blocks, whatever the model.
[[nodiscard]] bool is_uber_port(std::string_view name);

}  // namespace gobo::verify
