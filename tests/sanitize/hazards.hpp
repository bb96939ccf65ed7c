// Hazards of every kind, each planted in a shader of its own, and the same shader with a guard.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "sanitize_support.hpp"

namespace gobo {

/// The body of main() and what stands before it. x, y, v, w, uv and v4 are inputs, i and j flat ones; M,
/// table and on are uniforms; c is the colour.
struct HazardSource {
    std::string body;
    std::string declarations = "";
};

enum class Setting {
    fragment,
    no_color,  ///< the body alone writes the colour
    vertex,
    vulkan,           ///< Vulkan's GLSL, without uniforms
    mediump,          ///< GLSL ES, floats of 16 bits
    mediump_flushed,  ///< and also with those below 2^-14 taken as 0
    every_machine,    ///< on all variants of arithmetic
};

struct Hazard {
    std::string name;
    std::string message;
    HazardSource hazard;
    HazardSource guarded;
    std::vector<Domain> domains = {};
    Setting setting = Setting::fragment;
};

/// For the names of tests.
std::ostream& operator<<(std::ostream& stream, const Hazard& hazard);

[[nodiscard]] std::vector<Hazard> texture_hazards();
[[nodiscard]] std::vector<Hazard> undefined_value_hazards();
[[nodiscard]] std::vector<Hazard> constant_hazards();
[[nodiscard]] std::vector<Hazard> precision_hazards();
[[nodiscard]] std::vector<Hazard> lost_number_hazards();
[[nodiscard]] std::vector<Hazard> arithmetic_hazards();

}  // namespace gobo
