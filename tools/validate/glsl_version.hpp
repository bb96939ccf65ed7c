// The #version of a composed stage, and the one glslang can make SPIR-V from.
#pragma once

#include <string>
#include <string_view>

namespace gobo {

/// A `#version` line: 330 and "core"; 300 and "es".
struct GlslVersion {
    int number = 110;  ///< what GLSL means where no version is stated
    bool es = false;
    std::string profile;
};

/// The version that stands on the first line of a prologue.
[[nodiscard]] GlslVersion version_of(std::string_view prologue);

/// Whether glslang makes SPIR-V of the version as it is: desktop from 330, ES from 310.
[[nodiscard]] bool makes_spirv(const GlslVersion& version);

/// The prologue with its version raised to the lowest one that glslang makes SPIR-V of, and the functions
/// that have since been renamed defined by their new names.
[[nodiscard]] std::string raised_for_spirv(std::string_view prologue);

}  // namespace gobo
