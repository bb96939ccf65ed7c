// What `gobo build` writes: the C++ header that gives applications a family's permutations, its manifest and
// its depfile.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/file_system.hpp"
#include "core/text_template.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A key that a budget chose, with the figures that it was chosen by.
struct QualityChoice {
    Key key;
    /// Beyond the roundings of floats, at every input of the domain, as a part of the light that reaches the
    /// point or of 1 where less does; nothing where none is promised.
    std::optional<double> promised_error = {};
    double typical_error = 0;   ///< linear radiance; no scene like the study's is expected to err by more
    double measured_error = 0;  ///< the worst of the study's scenes
    double cost = 0;            ///< additions a fragment
    std::string source;         ///< "study", or "measured" for effects that the study does not hold
};

/// What a generated header and its manifest are made from.
struct EmitInput {
    const Family& family;
    const Composition& composition;
    const Interface& interface;                 ///< of all permutations together, as unite() makes it
    std::string cpp_namespace;                  ///< "lit" or "game::shaders"; empty: the family's name
    std::vector<QualityChoice> qualities = {};  ///< where a budget chose, for the manifest
    /// What permutations declare differently; `declared` goes by their order in the composition.
    std::vector<Differing> differing = {};
    /// Domains that are narrower than the family file's: errors are promised within them.
    std::vector<Domain> narrowed = {};
    /// By stage of the composition, for dialects of SPIR-V: what the header holds instead of texts.
    std::vector<std::span<const std::uint32_t>> modules = {};
    /// The header's file name where its tables of keys, texts and permutations go into a source file; empty:
    /// they stay in the header.
    std::string split_from = {};
};

/// What `gobo build` gives to a C++ compiler.
struct EmittedCpp {
    std::string header;
    std::string source;  ///< empty where the header holds all
};

/// The templates that a generated header is filled from, by name: "header", and "struct" and others for what
/// it holds several of.
using HeaderTemplates = std::map<std::string, TextTemplate, std::less<>>;

/// Reads NAME.hpp.in for each from `folder` (templates/header of the sources, or of the library in the
/// executable).
[[nodiscard]] Result<HeaderTemplates> read_header_templates(const FileSystem& files,
                                                            const std::string& folder);

/// The text of the header, and of its source file: C++17, constant data only. The same input gives the same
/// bytes. A namespace that is none is Fault::usage; a block that no C++ struct can mirror is Fault::input.
[[nodiscard]] Result<EmittedCpp> emit_header(const EmitInput& input, const HeaderTemplates& templates);

/// For programs that are not C++, as docs/formats.md tells. JSON: "family", "dialect", "features",
/// "interface" (as `gobo reflect --json`, with the header's bindings and locations), "pieces" (names),
/// "digits", "stages" (of each kind "columns" and "rows": a row's digits choose lists of pieces, which joined
/// are a stage) and "permutations" (key text, and the rows of its stages; where a budget chose it, by what),
/// sorted by key text. Where permutations declare names differently, "differing" lists these, and "declared"
/// of a permutation which declaration it has of each; "domain" has what is narrower than the family file's.
/// One row or permutation a line. The same input gives the same bytes.
[[nodiscard]] std::string emit_manifest(const EmitInput& input);

/// A rule in the syntax of make (and so of Ninja and CMake): the outputs depend on the files, each named
/// once, in the order given. Blanks, '#' and '$' in names are escaped.
[[nodiscard]] std::string emit_depfile(const std::vector<std::string>& outputs,
                                       const std::vector<std::string>& files);

/// The GLSL version of the stages: "450", "330", "es300", "vulkan", "gl_spirv", or what the #version of a
/// family with its own dialect states.
[[nodiscard]] std::string version_of(const Composition& composition);

}  // namespace gobo
