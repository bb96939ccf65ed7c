// What the ubershader reads where it does what a model of `lit` says.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lab/verify/inputs.hpp"

namespace gobo::uber {

/// Where one of its inputs or uniforms gets its value: from what `lit` reads by that name, else a number.
struct UberPort {
    std::string lit_name;
    double number = 0;
};

/// Of a reflected name in the blocks that the ubershader has and `lit` has not, or not so:
/// "Switches.diffuse", "SwitchedLights.lights[3].shadow.layer", "LoopedLights.spot[0].axis", "Toon.tones",
/// "Materials.rows[0].diffuse" where the model has one material. Lights stand in the order directional,
/// point, spot, directional_or_point; lights beyond them are switched off, and what a light does not have is
/// 0. Nothing for names that mean the same in both.
[[nodiscard]] std::optional<UberPort> uber_port(const oracle::Model& model, std::string_view name);

/// What a sample has by a reflected name of the ubershader; `own` is what it has by the name in `lit`. Such
/// fields are read, not set: no sample is made of what an ubershader was given.
[[nodiscard]] std::optional<verify::Field> uber_field(const std::string& name,
                                                      std::optional<verify::Field> own);

}  // namespace gobo::uber
