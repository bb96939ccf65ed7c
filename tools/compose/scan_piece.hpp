// Reads what composing must know of one GLSL file: its includes, its #version, its conditions and macros.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compose/dialect.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// A line that the preprocessor reads.
struct Directive {
    std::string word;  ///< "ifdef", "include"
    std::string rest;  ///< what stands behind the word
    Place place;
    std::string line;  ///< as it stands in the file, for diagnostics
};

/// `#include <name>` or `#include "path"`.
struct Include {
    bool in_angles = false;
    std::string target;
    Place place;
    std::string line;    ///< as it stands in the file, for diagnostics
    bool at_top = true;  ///< of its file: what is there already is not placed again
};

/// The two pragmas around a loop that the composer may unroll.
inline constexpr std::string_view kUnrollStart = "unroll_loop_start";
inline constexpr std::string_view kUnrollEnd = "unroll_loop_end";

/// One GLSL file as the composer sees it.
struct ScannedPiece {
    std::string text;  ///< the file with the lines of #include, #version, #extension, #line and #pragma once
                       ///< blanked, ending in a newline
    std::string code;  ///< `text` with blanks for its comments, line for line and column for column
    std::string version;                  ///< "330 core" of its #version line, or empty
    Directive version_line;               ///< that line
    std::vector<Include> includes;        ///< those at its top
    std::vector<Directive> directives;    ///< below that, in order: conditions, macros, further includes,
                                          ///< extensions under conditions, the pragmas around loops
    Extensions extensions;                ///< those under no condition
    bool is_once = false;                 ///< it says `#pragma once`
    std::string guard;                    ///< the macro that an #ifndef around the whole file asks for
    Diagnostics warnings;                 ///< of comments
    std::map<std::string, int> bindings;  ///< stated by BLOCK(binding, name) and SAMPLER(binding, type) name
};

/// Scans a file; messages quote the lines of `file`, which has as many. Errors: a malformed include or
/// #version, a comment or a condition without an end, brackets nested so deeply that parsing the shader could
/// exhaust the stack, bytes that are no text.
[[nodiscard]] Result<ScannedPiece> scan_piece(const std::string& text, const std::string& path,
                                              const std::string& file);
[[nodiscard]] inline Result<ScannedPiece> scan_piece(const std::string& text, const std::string& path) {
    return scan_piece(text, path, text);
}

/// A block or sampler declared by BLOCK(binding, name) or SAMPLER(binding, type) name.
struct StatedBinding {
    std::string name;
    int binding = 0;
    bool is_sampler = false;
};
[[nodiscard]] std::vector<StatedBinding> stated_bindings(std::string_view code);

/// What an include names.
[[nodiscard]] Result<Include> read_include(const Directive& directive);

/// Adds what a directive `#extension NAME : BEHAVIOR` asks for. Where only the driver knows whether it is
/// asked at all, `require` is `enable`. False where that is not its form.
bool add_extension(Extensions& extensions, const Directive& directive, bool is_certain = true);

/// A warning where an extension is disabled behind where it was asked for.
[[nodiscard]] Diagnostic ended_extension(const std::string& name, const Extension& begun,
                                         const Extension& ended);

/// They point into `code`.
[[nodiscard]] std::set<std::string_view> identifiers_of(std::string_view code);

}  // namespace gobo
