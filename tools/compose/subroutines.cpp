#include "compose/subroutines.hpp"

#include <algorithm>

#include "compose/tokens.hpp"

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

}  // namespace

std::vector<SubroutineUniform> subroutine_uniforms(const std::string& code) {
    std::vector<SubroutineUniform> uniforms;
    if (code.find("subroutine") == std::string::npos) return uniforms;
    const Tokens tokens = tokens_of(code);
    const auto is = [&](std::size_t at, std::string_view token) {
        return at < tokens.size() && tokens[at] == token;
    };
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i) {
        if (!is(i, "subroutine") || !is(i + 1, "uniform")) continue;
        SubroutineUniform& uniform = uniforms.emplace_back();
        uniform.name = tokens[i + 3];
        for (std::size_t j = 0; j < tokens.size(); ++j) {
            if (!is(j, "subroutine") || !is(j + 1, "(")) continue;
            const std::size_t end = find(tokens, ")", j);
            const auto types = tokens.begin();
            const bool has_type =
                std::find(types + static_cast<std::ptrdiff_t>(j), types + static_cast<std::ptrdiff_t>(end),
                          tokens[i + 2]) != types + static_cast<std::ptrdiff_t>(end);
            if (has_type && end + 2 < tokens.size()) uniform.functions.emplace_back(tokens[end + 2]);
        }
    }
    return uniforms;
}

int line_of_subroutine_array(const std::string& code, const std::set<std::string>& chosen) {
    if (chosen.empty() || code.find("subroutine") == std::string::npos) return 0;
    const Tokens tokens = tokens_of(code);
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i)
        if (tokens[i] == "subroutine" && tokens[i + 1] == "uniform" && tokens[i + 4] == "[" &&
            chosen.contains(std::string(tokens[i + 3])))
            return 1 + static_cast<int>(std::count(code.data(), tokens[i].data(), '\n'));
    return 0;
}

void choose_subroutines(std::string& text, std::string& code, const std::set<std::string>& chosen) {
    const std::vector<SubroutineUniform> uniforms = subroutine_uniforms(code);
    if (chosen.empty() || code.find("subroutine") == std::string::npos ||
        !std::ranges::all_of(uniforms, [&](const auto& uniform) { return chosen.contains(uniform.name); }))
        return;
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
}

}  // namespace gobo
