#include "compose/subroutines.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

using Tokens = std::vector<std::string_view>;

/// From one token to another, the last one included.
struct Range {
    std::size_t first;
    std::size_t last;
};

/// The place of the token from `from` on; the last place where there is none.
std::size_t find(const Tokens& tokens, std::string_view token, std::size_t from) {
    const auto found = std::find(tokens.begin() + static_cast<std::ptrdiff_t>(from), tokens.end(), token);
    return static_cast<std::size_t>(std::min(found, tokens.end() - 1) - tokens.begin());
}

/// Where `layout(index = 2)` or `layout(location = 0)` before the token begins; else the token.
std::size_t with_layout(const Tokens& tokens, std::size_t at) {
    if (at < 6 || tokens[at - 1] != ")" || tokens[at - 5] != "(" || tokens[at - 6] != "layout") return at;
    return at - 6;
}

/// What is to be blanked for one `subroutine`.
Range range_of(const Tokens& tokens, std::size_t at) {
    const std::string_view next = at + 1 < tokens.size() ? tokens[at + 1] : std::string_view();
    if (next == "(") return {with_layout(tokens, at), find(tokens, ")", at)};
    if (next == "uniform") return {with_layout(tokens, at), find(tokens, ";", at)};
    return {at, at};  // of a type, which stays as the declaration of a function
}

/// The line that a token of the code stands on.
int line_of(const std::string& code, std::string_view token) {
    return 1 + static_cast<int>(std::count(code.data(), token.data(), '\n'));
}

std::string joined(const Tokens& tokens, std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) text += (i == begin ? "" : " ") + std::string(tokens[i]);
    return text;
}

/// The functions that stand behind `subroutine(TYPE)`.
std::vector<std::string> functions_of_type(const Tokens& tokens, std::string_view type) {
    std::vector<std::string> functions;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (tokens[i] != "subroutine" || tokens[i + 1] != "(") continue;
        const std::size_t end = find(tokens, ")", i);
        const bool has_type = std::find(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                                        tokens.begin() + static_cast<std::ptrdiff_t>(end),
                                        type) != tokens.begin() + static_cast<std::ptrdiff_t>(end);
        const std::size_t name = find(tokens, "(", end) - 1;  // behind a result such as "highp vec4"
        if (has_type && name > end) functions.emplace_back(tokens[name]);
    }
    return functions;
}

std::string argument(std::size_t index) {
    return fmt::format("argument_{}", index);
}

/// The place behind brackets that begin there, if any do.
std::size_t behind_brackets(const Tokens& tokens, std::size_t at, std::size_t end) {
    while (at < end && tokens[at] == "[") at = find(tokens, "]", at) + 1;
    return std::min(at, end);
}

/// "const in vec3 n [ 2 ]" with a name that hides no function.
std::string parameter(const Tokens& tokens, std::size_t begin, std::size_t end, std::size_t index) {
    constexpr std::array<std::string_view, 13> kQualifiers = {
        "const",   "in",       "out",      "inout",    "lowp",     "mediump",  "highp",
        "precise", "coherent", "volatile", "restrict", "readonly", "writeonly"};
    std::size_t type = begin;
    while (type < end && std::ranges::find(kQualifiers, tokens[type]) != kQualifiers.end()) ++type;
    const std::size_t name = behind_brackets(tokens, std::min(type + 1, end), end);
    return fmt::format("{} {}{}", joined(tokens, begin, name), argument(index),
                       name < end ? joined(tokens, name + 1, end) : "");
}

}  // namespace

std::vector<SubroutineUniform> subroutine_uniforms(const std::string& code) {
    std::vector<SubroutineUniform> uniforms;
    if (code.find("subroutine") == std::string::npos) return uniforms;
    const Tokens tokens = tokens_of(code);
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i) {
        if (tokens[i] != "subroutine" || tokens[i + 1] != "uniform") continue;
        const std::size_t end = find(tokens, ";", i);
        for (std::size_t at = i + 3; at < end;
             at = find(tokens, ",", at) + 1)  // "uniform Shade front, back;"
            uniforms.push_back({std::string(tokens[at]), std::string(tokens[i + 2]),
                                functions_of_type(tokens, tokens[i + 2]), line_of(code, tokens[end])});
    }
    return uniforms;
}

std::vector<SubroutineType> subroutine_types(const std::string& code) {
    std::vector<SubroutineType> types;
    if (code.find("subroutine") == std::string::npos) return types;
    const Tokens tokens = tokens_of(code);
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (tokens[i] != "subroutine" || tokens[i + 1] == "(" || tokens[i + 1] == "uniform") continue;
        const std::size_t open = find(tokens, "(", i);
        if (open < i + 3) continue;
        SubroutineType& type = types.emplace_back();
        type.name = tokens[open - 1];
        type.result = joined(tokens, i + 1, open - 1);
        const std::size_t end = find(tokens, ")", open);
        for (std::size_t at = open + 1; at < end;) {
            std::size_t comma = at;
            while (comma < end && tokens[comma] != ",") ++comma;
            if (joined(tokens, at, comma) != "void")
                type.parameters.push_back(parameter(tokens, at, comma, type.parameters.size()));
            at = comma + 1;
        }
    }
    return types;
}

std::string prototype_of(const SubroutineUniform& uniform, const SubroutineType& type) {
    return fmt::format("{} {}({})", type.result, uniform.name, join(type.parameters, ", "));
}

std::string call_of(const SubroutineUniform& uniform, const SubroutineType& type, std::string_view function) {
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < type.parameters.size(); ++i) arguments.push_back(argument(i));
    return fmt::format("{} {{ {}{}({}); }}", prototype_of(uniform, type),
                       type.result == "void" ? "" : "return ", function, join(arguments, ", "));
}

int line_of_subroutine_array(const std::string& code, const std::set<std::string>& chosen) {
    if (chosen.empty() || code.find("subroutine") == std::string::npos) return 0;
    const Tokens tokens = tokens_of(code);
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i)
        if (tokens[i] == "subroutine" && tokens[i + 1] == "uniform" && tokens[i + 4] == "[" &&
            chosen.contains(std::string(tokens[i + 3])))
            return line_of(code, tokens[i]);
    return 0;
}

bool choose_subroutines(std::string& text, std::string& code, const std::set<std::string>& chosen) {
    const std::vector<SubroutineUniform> uniforms = subroutine_uniforms(code);
    if (chosen.empty() || code.find("subroutine") == std::string::npos ||
        !std::ranges::all_of(uniforms, [&](const auto& uniform) { return chosen.contains(uniform.name); }))
        return false;
    const std::string original = code;
    const Tokens tokens = tokens_of(original);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] != "subroutine") continue;
        const Range range = range_of(tokens, i);
        const auto begin = static_cast<std::size_t>(tokens[range.first].data() - original.data());
        const auto end =
            static_cast<std::size_t>(tokens[range.last].data() - original.data()) + tokens[range.last].size();
        for (std::size_t at = begin; at < end; ++at)
            if (original[at] != ' ' && original[at] != '\n') text[at] = code[at] = ' ';
    }
    return true;
}

}  // namespace gobo
