// What differs between the GLSL dialects: the version line and six macros by which pieces spell their
// interfaces.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"

namespace gobo {

/// "450", "330", "es300", "vulkan" or "gl_spirv"; Dialect::own is "450", the dialect of templates that state
/// no version.
[[nodiscard]] std::string_view name_of(Dialect dialect);
[[nodiscard]] std::optional<Dialect> dialect_of(std::string_view name);
/// "450|330|es300|vulkan|gl_spirv".
[[nodiscard]] std::string dialect_words();

/// A `#version` line: 330 and "core"; 300 and "es".
struct GlslVersion {
    int number = 110;  ///< what GLSL means where no version is stated
    bool es = false;
    std::string profile;
};

/// The version that a source states.
[[nodiscard]] GlslVersion version_of(std::string_view source);

/// The macros that drivers define by the version: "__VERSION__ 330", "GL_core_profile 1".
[[nodiscard]] std::vector<std::string> version_macros(const GlslVersion& version);

/// What `#extension` asks for.
struct Extension {
    std::string behavior;  ///< "require", "enable", "warn" or "disable"
    Place place = {};
    std::string line = {};  ///< as it stands in the file
};
using Extensions = std::map<std::string, Extension>;

/// Of two behaviors for one name the stronger holds. False where GLSL has no such behavior.
bool add_extension(Extensions& extensions, const std::string& name, Extension extension);

/// Asks whether a stage mentions an identifier.
using Mentions = std::function<bool(std::string_view)>;

/// Where Vulkan binds a block or a sampler that a stage declares.
struct DescriptorPlace {
    std::string name;
    int number = 0;           ///< that BLOCK or SAMPLER states
    bool is_sampler = false;  ///< declared by SAMPLER
    int set = 0;
    int binding = 0;
};

/// The place of a resource: where the family's descriptor sets list it, else in set 0 at the number that it
/// states.
[[nodiscard]] DescriptorPlace descriptor_place(const Family& family, std::string name, int number,
                                               bool is_sampler);

/// The head of a prologue: the version line, the extensions, sorted, then of the macros those that the stage
/// mentions: BLOCK(binding, name), VARYING(location), ATTRIBUTE(location), OUTPUT(location),
/// SAMPLER(binding, type), DEPTH(qualifier). `own_version` is the template's own #version, used where the
/// dialect is Dialect::own, and by those of SPIR-V where it is later than theirs. `places`, of the resources
/// that the stage declares, count for Vulkan alone.
[[nodiscard]] std::string dialect_prologue(Dialect dialect, StageKind stage, std::string_view own_version,
                                           Extensions extensions, const Mentions& mentions,
                                           const std::vector<DescriptorPlace>& places = {});

}  // namespace gobo
