#include "validate/plain_messages.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/declaration.hpp"

namespace gobo {
namespace {

/// What stands behind a mark in a message, if it does.
std::string_view behind(std::string_view message, std::string_view mark) {
    const auto at = message.find(mark);
    return at == std::string_view::npos ? std::string_view() : trim(message.substr(at + mark.size()));
}

/// "f" of "f(f1;": glslang's name for a function.
std::string_view function_name(std::string_view mangled) {
    return mangled.substr(0, mangled.find('('));
}

/// The two declarations that a message quotes: "vec3 a" and "vec3 b".
std::array<std::string, 2> quoted(std::string_view message) {
    std::array<std::string, 2> texts;
    for (std::string& text : texts) {
        message = message.substr(std::min(message.find('"'), message.size()));
        if (message.empty()) break;
        text = trim(message.substr(1, message.find('"', 1) - 1));
        message = message.substr(std::min(message.find('"', 1), message.size() - 1) + 1);
    }
    return texts;
}

/// The last name in a declaration: "a" of "layout( location=0) smooth in vec3 a".
std::string last_name(std::string_view declaration) {
    std::string name;
    for (const std::string_view token : tokens_of(declaration))
        if (is_identifier(token)) name = token;
    return name;
}

Diagnostic function_message(std::string_view message, const PieceList& pieces) {
    const std::string_view found = behind(message, "No function definition (body) found:");
    if (!found.empty()) {
        const std::string_view name = function_name(found);
        return diagnostic_at(use_of(name, pieces), Severity::error,
                             fmt::format("the function '{}' has no body", name),
                             "write it, or include the piece that holds it");
    }
    const std::string_view caller = behind(message, "Recursion detected:");
    const std::string_view name = function_name(caller);
    const std::string_view called = function_name(behind(caller, "calling"));
    return diagnostic_at(
        use_of(name, pieces), Severity::error,
        name == called ? fmt::format("the function '{}' calls itself", name)
                       : fmt::format("the function '{}' calls '{}', which leads back to it", name, called),
        "GLSL has no recursion: write a loop");
}

/// Of two declarations that must match.
Diagnostic mismatch_message(std::string_view message, const PieceList& pieces, const PieceList& earlier) {
    const auto [there, here] = quoted(message);
    const std::string_view initialised = behind(message, "Initializers must match:");
    const std::string name = last_name(initialised.empty() ? here : initialised);
    const Declaration at = declaration_of(name, "", pieces);
    const std::string other =
        declaration_of(initialised.empty() ? last_name(there) : name, "", earlier).text();
    const char* const help = "declare it alike in both stages";
    if (!initialised.empty())
        return diagnostic_at(at, Severity::error,
                             fmt::format("'{}' begins with another value here than in {}", name, other),
                             help);
    const bool is_of_sizes = message.find("Array sizes must be compatible:") != std::string_view::npos;
    if (there == here && is_of_sizes)
        return diagnostic_at(
            at, Severity::error,
            fmt::format("a constant cannot be the size of '{}', which one stage hands to the next", name),
            "write the number");
    if (there == here)  // glslang leaves out the name of a struct
        return diagnostic_at(at, Severity::error,
                             fmt::format("'{}' is of a struct with another name in {}", name, other), help);
    const auto text = [&](std::string_view declaration) {  // of a struct glslang says the members
        return trim(declaration.substr(is_of_sizes ? declaration.rfind('}') + 1 : 0));
    };
    return diagnostic_at(at, Severity::error,
                         fmt::format("'{}' here, but '{}' in {}", text(here), text(there), other), help);
}

/// Where the stage defines macros, the first time.
std::map<std::string_view, Place> macros_of(const std::vector<ActiveDirective>& directives) {
    std::map<std::string_view, Place> macros;
    for (const ActiveDirective& directive : directives) {
        const std::vector<std::string_view> tokens = tokens_of(directive.rest);
        if (directive.word == "define" && !tokens.empty())
            macros.try_emplace(tokens.front(), Place{directive.piece->path, directive.line, 0});
    }
    return macros;
}

std::string text_of(const Place& place) {
    return fmt::format("{}:{}", place.file, place.line);
}

/// At the second block of push constants.
Diagnostic push_constants_message(const PieceList& pieces) {
    std::vector<Declaration> blocks;
    for (const Piece* const piece : pieces) {
        const auto lines = 1 + std::ranges::count(piece->text, '\n');
        for (int number = 1; number <= lines; ++number) {
            const std::string_view line = line_of(piece->text, number);
            const std::vector<std::string_view> tokens = tokens_of(line);
            if (std::ranges::find(tokens, "push_constant") != tokens.end())
                blocks.push_back({{piece->path, piece->line_in_file(number), 0}, std::string(line)});
        }
    }
    blocks.resize(std::max<std::size_t>(blocks.size(), 2), {{pieces.back()->path, 0, 0}, ""});
    return diagnostic_at(
        blocks[1], Severity::error,
        fmt::format("a second block of push constants, beside that of {}: a stage has one", blocks[0].text()),
        "put the members of both into one block");
}

}  // namespace

Diagnostic color_and_data_message(const PieceList& pieces) {
    return diagnostic_at(use_of("gl_FragData", pieces), Severity::error,
                         "a stage writes gl_FragColor or gl_FragData, not both",
                         "write gl_FragData[0] in place of gl_FragColor");
}

Diagnostics with_places(Diagnostics found, const PieceList& pieces, const PieceList& earlier) {
    for (Diagnostic& diagnostic : found) {
        const std::string message = diagnostic.message;
        const auto says = [&](std::string_view text) { return message.find(text) != std::string::npos; };
        if (says("Recursion detected:") || says("No function definition (body) found:"))
            diagnostic = function_message(message, pieces);
        else if (!earlier.empty() && ((says("must match") || says("sizes must be compatible")) &&
                                      (says("\"") || says("Initializers"))))
            diagnostic = mismatch_message(message, pieces, earlier);
        else if (says("Cannot use both gl_FragColor and gl_FragData"))
            diagnostic = color_and_data_message(pieces);
        else if (says("Only one push_constant block is allowed per stage"))
            diagnostic = push_constants_message(pieces);
        else if (message.starts_with("Linking ") && says(": "))  // "Linking unknown stage stage: "
            diagnostic.message = message.substr(message.find(": ") + 2);
    }
    return found;
}

Diagnostics with_macros(Diagnostics found, const std::vector<ActiveDirective>& directives) {
    // What Vulkan cannot bind is an error of its own.
    std::erase_if(found, [](const Diagnostic& diagnostic) {
        return diagnostic.message.starts_with("'[][]' : Generating SPIR-V array-of-arrays");
    });
    if (found.empty()) return found;
    const std::map<std::string_view, Place> macros = macros_of(directives);
    for (Diagnostic& diagnostic : found) {
        if (diagnostic.message.ends_with("only allowed when using GLSL for Vulkan")) {
            diagnostic.help = "it is written for Vulkan: --dialect vulkan takes it";
            continue;
        }
        if (diagnostic.message == "'subgroup op' : requires SPIR-V 1.3") {
            diagnostic.message = "the SPIR-V of Vulkan 1.0 and OpenGL has no subgroups";
            diagnostic.help = "do it without GL_KHR_shader_subgroup_...";
            continue;
        }
        const std::string_view redefined =
            behind(diagnostic.message, "Macro redefined; different substitutions:");
        if (const auto first = macros.find(redefined); first != macros.end()) {
            diagnostic.message =
                fmt::format("the macro '{}' has another meaning in {}", redefined, text_of(first->second));
            diagnostic.help = "give one of them another name, or #undef it behind its last use";
            continue;
        }
        const std::vector<std::string_view> tokens = tokens_of(diagnostic.quoted_line);
        const std::string_view message = diagnostic.message;
        const std::string_view name = message.substr(1, std::max<std::size_t>(message.find('\'', 1), 1) - 1);
        const bool is_written = std::ranges::find(tokens, name) != tokens.end();
        const bool is_syntax = message.find("syntax error") != std::string_view::npos;
        if (!diagnostic.help.empty() || !message.starts_with('\'') || (is_written && !is_syntax)) continue;
        for (const std::string_view token : tokens)
            if (const auto macro = macros.find(token);
                macro != macros.end() && text_of(macro->second) != text_of(diagnostic.place))
                diagnostic.help =
                    fmt::format("'{}' is a macro here: {} defines it", token, text_of(macro->second));
    }
    return found;
}

}  // namespace gobo
