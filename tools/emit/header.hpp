// The C++ header that gives applications a family's permutations: the last stage of the flow.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "emit/header_templates.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A key that a budget chose, with the figures that it was chosen by.
struct QualityChoice {
    Key key;
    double promised_error = 0;  ///< linear radiance; no scene's is expected to be larger
    double measured_error = 0;  ///< the worst of the study's scenes
    double cost = 0;            ///< additions a fragment
    std::string source;         ///< "study", or "measured" for effects that the study does not hold
};

/// What a generated header and its manifest are made from.
struct EmitInput {
    const Family& family;
    const Composition& composition;
    const Interface& interface;  ///< of all permutations together: the largest extent of each array
    std::string cpp_namespace;   ///< "lit" or "game::shaders"; empty: the family's name
    std::vector<QualityChoice> qualities = {};  ///< where a budget chose, for the manifest
};

/// The text of the header: C++17, constant data only. The same input gives the same bytes. A namespace that
/// is none is Fault::usage; a block that no C++ struct can mirror is Fault::input.
[[nodiscard]] Result<std::string> emit_header(const EmitInput& input, const HeaderTemplates& templates);

/// The GLSL version of the stages: "450", "330", "es300", or what the #version of a family with its own
/// dialect states.
[[nodiscard]] std::string version_of(const Composition& composition);

}  // namespace gobo
