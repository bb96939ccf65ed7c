#include "core/toml_depth.hpp"

#include <algorithm>
#include <string>

#include "core/text.hpp"

namespace gobo {
namespace {

/// Behind the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const std::string three(3, quote);
    const bool is_long = text.substr(at).starts_with(three);
    const std::string_view mark = is_long ? std::string_view(three) : text.substr(at, 1);
    for (at += mark.size(); at < text.size(); ++at) {
        if (text.substr(at).starts_with(mark)) return at + mark.size();
        if (text[at] == '\n' && !is_long) return at;
        if (text[at] == '\\' && quote == '"') ++at;
    }
    return text.size();
}

}  // namespace

int line_of_overlong_key(std::string_view text) {
    int dots = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '#') at = std::min(text.find('\n', at), text.size() - 1);
        if (c == '"' || c == '\'') at = end_of_string(text, at) - 1;
        const bool goes_on =
            is_identifier_part(c) || c == '-' || c == ' ' || c == '\t' || c == '"' || c == '\'';
        dots = c == '.' ? dots + 1 : goes_on ? dots : 0;
        if (dots >= kMostKeyParts) return 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
    }
    return 0;
}

}  // namespace gobo
