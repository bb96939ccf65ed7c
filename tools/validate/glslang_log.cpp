#include "validate/glslang_log.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "compose/piece_marks.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// How many errors of a stage, and how many warnings, are told. Nobody reads more, and each is looked up.
constexpr int kMostTold = 100;

/// glslang has read on to the next line, or further, where it finds a directive wrong: the directive's line.
int line_of_directive(std::string_view message, const Piece& piece, int line) {
    const std::string_view word = message.starts_with("'#extension'")                ? "extension"
                                  : message.starts_with("'preprocessor evaluation'") ? "if"
                                                                                     : "";
    for (int above = line; !word.empty() && above > 0; --above) {
        const std::vector<std::string_view> tokens = tokens_of(line_of(piece, above));
        if (tokens.size() > 1 && tokens[0] == "#" &&
            (tokens[1] == word || (word == "if" && tokens[1] == "elif")))
            return above;
    }
    return line;
}

/// Names what the family made of a line, where a word of it stands nowhere in the file.
void explain_rewriting(Diagnostic& diagnostic, const Piece& piece, int line) {
    if (piece.file_text.empty() || !diagnostic.help.empty()) return;
    const std::string_view made = trim(line_of(piece.text, line - piece.first_line + 1));
    const std::vector<std::string_view> written = tokens_of(piece.file_text);
    const std::string own(line_of(piece, line));
    // What the composer itself puts there: the line's number, and what is as wrong as a lone quotation mark.
    const auto is_composers = [&](std::string_view token) {
        return (token == "'" && own.find('"') != std::string::npos) ||
               (own.find("__LINE__") != std::string::npos && token == std::to_string(line)) ||
               (own.find("__FILE__") != std::string::npos && token == "0");
    };
    for (const std::string_view token : tokens_of(made))
        if (std::ranges::find(written, token) == written.end() && !is_composers(token)) {
            diagnostic.help =
                fmt::format("[substitute], or what else the family rewrites, makes of it: {}", made);
            return;
        }
}

/// Moves `7:12: rest`, line 12 of the piece at position 7, to its place.
void locate(Diagnostic& diagnostic, const std::vector<const Piece*>& pieces) {
    const std::string message = diagnostic.message;
    const char* const end = message.data() + message.size();
    std::size_t position = 0;
    int line = 0;
    const auto before = std::from_chars(message.data(), end, position);
    if (before.ec != std::errc{} || before.ptr == end || *before.ptr != ':' || position >= pieces.size())
        return;
    const auto behind = std::from_chars(before.ptr + 1, end, line);
    if (behind.ec != std::errc{} || behind.ptr == end || *behind.ptr != ':') return;
    const Piece& piece = *pieces[position];
    diagnostic.message = trim({behind.ptr + 1, end});
    line = line_of_directive(diagnostic.message, piece, piece.line_in_file(line));
    put_at(diagnostic, piece, line);
    explain_rewriting(diagnostic, piece, line);
}

/// Says which count has the constant_id that a shader states, too.
void explain_constant_id(Diagnostic& diagnostic, const Piece& prologue) {
    if (!diagnostic.message.starts_with("'constant_id' : specialization-constant id already used")) return;
    const std::vector<std::string_view> tokens = tokens_of(diagnostic.quoted_line);
    const auto at = std::ranges::find(tokens, "constant_id");
    if (tokens.end() - at < 3) return;
    const std::string declared = fmt::format("layout(constant_id = {}) const int ", at[2]);
    const std::size_t found = prologue.text.find(declared);
    if (found == std::string::npos) {
        diagnostic.message = fmt::format("another constant has constant_id {}, too", at[2]);
        diagnostic.help = "give each constant a number of its own";
        return;
    }
    const std::string_view behind = std::string_view(prologue.text).substr(found + declared.size());
    diagnostic.message = id_of_count(std::atoi(at[2].data()), behind.substr(0, behind.find(' ')));
    diagnostic.help = kIdsOfCounts;
}

/// glslang stops at the first uniform outside of blocks.
void name_other_uniforms(Diagnostic& diagnostic, const std::vector<const Piece*>& pieces) {
    if (!diagnostic.message.starts_with("a uniform outside of blocks")) return;
    std::vector<std::string> others;
    for (const Piece* const piece : pieces) {
        int number = piece->first_line - 1;
        for_each_line(piece->text, [&](std::string_view line) {
            ++number;
            const std::vector<std::string_view> tokens = tokens_of(line);
            const auto uniform = std::ranges::find(tokens, "uniform");
            const bool is_plain = tokens.end() - uniform > 2 && tokens.back() == ";" && glsl_type(uniform[1]);
            if (is_plain && !(piece->path == diagnostic.place.file && number == diagnostic.place.line))
                others.push_back(fmt::format("{}:{}", piece->path, number));
            return true;
        });
    }
    if (!others.empty()) diagnostic.help += fmt::format("; so must those of {}", join(others, ", "));
}

/// "textureLod" of "texture2DLod"; empty where no later version has another name for it.
std::string name_of_lookup(std::string_view old) {
    for (const std::string_view first :
         {"texture2DRect", "texture1D", "texture2D", "texture3D", "textureCube"})
        if (old.starts_with(first)) return fmt::format("texture{}", old.substr(first.size()));
    return {};
}

/// Of what OpenGL once had built in and no declaration can bring back.
std::string help_of_lost(std::string_view message) {
    if (message.starts_with("'gl_ClipVertex' : "))
        return "it went with the fixed clip planes: write gl_ClipDistance[i] = dot(gl_ClipPlane[i], "
               "position), which GLSL has from 1.30 on";
    if (message.ends_with(" : Reserved word.") && message.find("2DRect") != std::string_view::npos)
        return "write #extension GL_ARB_texture_rectangle : enable, or state #version 140";
    if (message.starts_with("'filename-based __FILE__' : "))
        return "write 0: a stage is one text to drivers, whose files they do not know";
    constexpr std::array<std::string_view, 4> kNoise = {
        "'noise1' : ", "'noise2' : ", "'noise3' : ", "'noise4' : "};
    if (message.ends_with("no matching overloaded function found") &&
        std::ranges::any_of(kNoise, [&](std::string_view name) { return message.starts_with(name); }))
        return "SPIR-V, by which shaders are checked, has no noise, and drivers give 0 for it (GLSL 4.60, "
               "8.14): write 0.0, or a noise function of your own";
    if (message.ends_with("no matching overloaded function found")) {
        const std::string_view name = message.substr(1, message.find('\'', 1) - 1);
        const std::string later = name_of_lookup(name);
        if (!later.empty())
            return fmt::format(
                "from GLSL 1.30 and ES 3.00 on it is called {0}: write that, or #define {1} {0}", later,
                name);
    }
    return {};
}

/// Adds what glslang leaves out: which extension, which numbers.
void explain(Diagnostic& diagnostic) {
    if (diagnostic.severity == Severity::warning &&
        diagnostic.message.starts_with("'#extension' : extension not supported"))
        diagnostic.help =
            "glslang, by which shaders are checked, does not know it: what it brings is refused";
    if (diagnostic.message.starts_with("'floating-point suffix' : not supported"))
        diagnostic.help = "take the suffix of the number out: 'f' came with GLSL 1.20 and ES 3.00";
    if (diagnostic.message.starts_with("'depth layout qualifier' : not supported for this version"))
        diagnostic.help = "write '#extension GL_ARB_conservative_depth : require', or raise #version to 420";
    if (diagnostic.message.starts_with("'depth layout qualifier' : not supported with this profile"))
        diagnostic.help = "OpenGL ES has it by GL_EXT_conservative_depth only, which glslang does not know";
    const bool is_string = diagnostic.message.starts_with("''' : character literals") ||
                           diagnostic.message.starts_with("'string literal' :");
    if (is_string && diagnostic.quoted_line.find('"') != std::string::npos) {
        diagnostic.message = "'\"' : GLSL has no strings";
        diagnostic.help = "take the quotation mark out";
    }
    if (diagnostic.message.starts_with("'##' : not supported for these tokens"))
        diagnostic.help = "glslang, by which shaders are checked, joins names alone: write the joined number";
    if (diagnostic.message.starts_with("'subroutine' : not allowed") ||
        diagnostic.message.starts_with("'subroutine' : feature not yet implemented")) {
        diagnostic.message = "'subroutine' : SPIR-V, by which shaders are checked, has no subroutines";
        diagnostic.help =
            "make each subroutine uniform a feature: [features.NAME] with define = \"UNIFORM\" and values = "
            "[\"FUNCTION\", \"FUNCTION\"]";
    }
    if (diagnostic.message.starts_with("'non-opaque uniforms outside a block' : not allowed when using")) {
        diagnostic.message = "a uniform outside of blocks, which Vulkan does not have";
        diagnostic.help =
            "put it into a block, such as layout(std140, set = 0, binding = 0) uniform Settings { vec4 tint; "
            "} settings;, or into push constants";
    }
    if (diagnostic.message.find("require") != std::string::npos &&
        diagnostic.message.find("layout(binding=X)") != std::string::npos)
        diagnostic.help =
            "declare it by BLOCK(N, name) or SAMPLER(N, type), or write layout(set = S, binding = N)";
    if (diagnostic.message.starts_with("'location' : SPIR-V requires location"))
        diagnostic.help = "write layout(location = N): where there is SPIR-V, names do not count";
    if (diagnostic.message.starts_with("'GL_ARB_bindless_texture' : not allowed"))
        diagnostic.help =
            "SPIR-V, by which shaders are checked, has no bindless textures: bind them to units";
    if (const std::string lost = help_of_lost(diagnostic.message); !lost.empty()) diagnostic.help = lost;
    if (!diagnostic.message.starts_with("'offset' : must be a multiple of")) return;
    const std::vector<std::string_view> tokens = tokens_of(diagnostic.quoted_line);
    const auto at = std::ranges::find(tokens, "offset");
    if (tokens.end() - at < 5 || at[1] != "=" || at[3] != ")") return;
    diagnostic.message = unaligned_text(at[2], at[4]);
}

/// The names of the specialisation constants that the text declares.
std::vector<std::string_view> specialization_constants_in(std::string_view text) {
    std::vector<std::string_view> names;
    const std::vector<std::string_view> tokens = tokens_of(text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] != "constant_id") continue;
        while (i < tokens.size() && tokens[i] != "=" && tokens[i] != ";") ++i;  // of the number
        for (++i; i < tokens.size() && tokens[i] != "=" && tokens[i] != ";"; ++i) {
        }
        if (i < tokens.size()) names.push_back(tokens[i - 1]);
    }
    return names;
}

}  // namespace

std::string unaligned_text(std::string_view offset, std::string_view type) {
    std::string text = "'offset' : must be a multiple of the member's alignment";
    // That of an array, a struct or a matrix is left to the reader.
    const std::optional<GlslType> known = glsl_type(type);
    if (known && !known->is_matrix())
        text += fmt::format(": {} is not a multiple of {}, to which a {} is aligned", offset,
                            known->column_alignment(), type);
    return text;
}

std::string id_of_count(int id, std::string_view count) {
    return fmt::format("constant_id {} is that of the count {}", id, count);
}

void make_strict(Diagnostic& diagnostic, std::string_view prologue, bool is_relaxed) {
    const auto says = [&](std::string_view text) { return diagnostic.message.starts_with(text); };
    if (diagnostic.severity != Severity::warning) return;
    if (says("'return' : type conversion on return values was not explicitly allowed until") &&
        prologue.find("GL_ARB_shading_language_420pack") == std::string_view::npos) {
        diagnostic.severity = Severity::error;
        diagnostic.message = "'return' of another type than the function's: GLSL converts it from 4.20 on";
        diagnostic.help = "write the value in the function's type, as 1.0 for a float, or state #version 420";
    }
    // Of what glslang's relaxed rules let pass, drivers take but one.
    constexpr std::array<std::string_view, 6> relaxed = {"The following extension must be enabled",
                                                         "undefined macro in expression",
                                                         "unexpected tokens following",
                                                         "requires declaration of default precision",
                                                         "(un)defined",
                                                         "non-constant global initializer"};
    for (const std::string_view text : relaxed)
        if (is_relaxed && diagnostic.message.find(text) != std::string::npos)
            diagnostic.severity = Severity::error;
    if (says("'switch' : last case/default label not followed by statements")) {
        diagnostic.severity = Severity::error;
        diagnostic.help = "write break; behind it";
    }
}

Diagnostics diagnostics_of_log(std::string_view log, const std::vector<const Piece*>& pieces,
                               const Place& otherwise, bool all) {
    constexpr std::string_view given_up = "'' : compilation terminated";
    // Where glslang gives up, an #extension seems to lack its line's end.
    const bool gave_up = log.find(given_up) != std::string_view::npos;
    const auto says_nothing = [&](std::string_view line) {
        const auto holds = [&](std::string_view text) { return line.find(text) != std::string_view::npos; };
        return holds(given_up) || holds(" compilation errors.") || holds("No code generated.") ||
               holds("all default precisions are highp") ||  // as GLSL has it
               (!all && holds("'subroutine' : feature not yet implemented")) ||
               (!all && gave_up && holds("'#extension' : extra tokens"));
    };
    Diagnostics diagnostics;
    int errors = 0;
    int warnings = 0;
    bool is_told = false;
    for (const std::string& full_line : split(log, '\n')) {
        const std::string_view line = full_line;
        if (says_nothing(line)) continue;
        const bool is_error = line.starts_with("ERROR: ");
        if (is_error || line.starts_with("WARNING: ")) {
            is_told = ++(is_error ? errors : warnings) <= kMostTold;
            if (!is_told) continue;
            Diagnostic& diagnostic = diagnostics.emplace_back();
            diagnostic.severity = is_error ? Severity::error : Severity::warning;
            diagnostic.place = otherwise;
            diagnostic.message = trim(line.substr(line.find(' ')));
            locate(diagnostic, pieces);
        } else if (is_told) {  // a message that goes on
            diagnostics.back().message += fmt::format(" {}", line);
        }
    }
    // The composer has seen to the ends of all conditions: another error keeps glslang from finding one.
    const auto is_missing_end = [](const Diagnostic& diagnostic) {
        return diagnostic.message == "'' : missing #endif";
    };
    if (!std::ranges::all_of(diagnostics, is_missing_end)) std::erase_if(diagnostics, is_missing_end);
    // What these bring is taken all the same (depth_layouts.hpp).
    std::erase_if(diagnostics, [](const Diagnostic& diagnostic) {
        return diagnostic.message.ends_with("not supported: GL_ARB_conservative_depth") ||
               diagnostic.message.ends_with("not supported: GL_AMD_conservative_depth");
    });
    const auto add_rest = [&](Severity severity, const char* what, int count) {
        if (count > kMostTold)
            diagnostics.push_back({.severity = severity,
                                   .place = otherwise,
                                   .message = fmt::format("{} more {}", count - kMostTold, what)});
    };
    add_rest(Severity::error, "errors", errors);
    add_rest(Severity::warning, "warnings", warnings);
    for (Diagnostic& diagnostic : diagnostics) {
        explain(diagnostic);
        name_other_uniforms(diagnostic, pieces);
        if (!pieces.empty()) explain_constant_id(diagnostic, *pieces.front());
    }
    return diagnostics;
}

void drop_consequences(Diagnostics& diagnostics) {
    std::set<std::pair<std::string, int>> faulty;
    std::erase_if(diagnostics, [&](const Diagnostic& found) {
        if (found.severity != Severity::error || found.place.line == 0) return false;
        const bool is_first = faulty.insert({found.place.file, found.place.line}).second;
        return !is_first && found.message.find("undeclared identifier") == std::string::npos;
    });
}

void explain_crash(Diagnostic& error, const std::vector<const Piece*>& pieces) {
    std::vector<std::string_view> constants;
    for (const Piece* const piece : pieces)
        std::ranges::copy(specialization_constants_in(piece->text), std::back_inserter(constants));
    for (const Piece* const piece : pieces) {
        int number = piece->first_line - 1;
        bool is_found = false;
        for_each_line(piece->text, [&](std::string_view line) {
            ++number;
            const std::vector<std::string_view> tokens = tokens_of(line);
            const auto label = std::ranges::find(tokens, "case");
            const auto end = std::find(label, tokens.end(), ":");
            const auto constant = std::find_first_of(label, end, constants.begin(), constants.end());
            is_found = constant != end;
            if (is_found) error.message += fmt::format(": '{}' is a specialisation constant", *constant);
            return !is_found;
        });
        if (!is_found) continue;
        error.help = "a case label is a number: compare with the constant by if";
        return put_at(error, *piece, number);
    }
}

}  // namespace gobo
