// Reads what composing must know of one GLSL file: its includes, its #version and the identifiers it
// mentions.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// `#include <feature>`, `#include <feature/part>` or `#include "path"`.
struct Include {
    bool of_feature = false;
    std::string target;
    Place place;
    std::string line;  ///< as it stands in the file, for diagnostics
};

/// One GLSL file as the composer sees it.
struct ScannedPiece {
    std::string text;  ///< the file with #include and #version lines blanked, ending in a newline
    std::string code;  ///< `text` with blanks for its comments, line for line and column for column; `text`
                       ///< itself where GLSL's versions may disagree on what is a comment
    std::string version;  ///< "330 core" of its #version line, or empty
    std::vector<Include> includes;
    std::set<std::string, std::less<>> identifiers;  ///< outside comments
    Diagnostics warnings;                            ///< uniform blocks whose layout is left to the driver
    std::map<std::string, int> bindings;  ///< stated by BLOCK(binding, name) and SAMPLER(binding, type) name
};

/// Scans a file. Errors: an include after code, a malformed include, a comment without an end, brackets
/// nested so deeply that parsing the shader could exhaust the stack, bytes that are no text.
[[nodiscard]] Result<ScannedPiece> scan_piece(std::string text, const std::string& path);

}  // namespace gobo
