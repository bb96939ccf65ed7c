// Pairs that break the rules of linking: what gobo says of each, and whether Mesa links it.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <glslang/build_info.h>

#include "core/diagnostic.hpp"

namespace gobo {

/// What Mesa makes of the pair.
enum class Mesa {
    links,
    refuses,
    older_refuses,  ///< as 22.3 does; 25.0 links
    is_lax,         ///< links, though the specification or a guaranteed limit is offended
};

struct LinkRow {
    const char* name;
    const char* version;
    const char* vertex;
    const char* fragment;
    Mesa mesa;
    std::vector<const char*> messages;  ///< each that gobo gives, in part
};

void PrintTo(const LinkRow& row, std::ostream* stream);

/// What gobo says of a pair called tiny.vert and tiny.frag.
[[nodiscard]] Diagnostics checked(const std::string& vertex, const std::string& fragment);

/// Expects the row's messages of gobo, an error unless it links, and its verdict of Mesa.
void expect_verdicts(const LinkRow& row);

/// Newer versions of glslang refuse by themselves some of what gobo refuses with older ones.
inline constexpr bool kNewerGlslang = GLSLANG_VERSION_MAJOR >= 15;

/// For the names of parameterised tests.
constexpr auto name_of_row = [](const auto& row) { return std::string(row.param.name); };

/// The least that a vertex stage holds, and a fragment stage.
inline constexpr const char* plain = "void main() { gl_Position = vec4(0.0); }\n";
inline constexpr const char* color = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";

}  // namespace gobo
