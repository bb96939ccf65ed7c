#include "compose/piece_marks.hpp"

#include <string>

#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view kMark = "#piece ";

bool is_name(std::string_view text) {
    const auto fits = [](char c) { return is_identifier_part(c) || c == '/' || c == '.' || c == '-'; };
    return !text.empty() && std::ranges::all_of(text, fits);
}

}  // namespace

std::optional<std::string_view> marked(std::string_view line) {
    if (!line.starts_with(kMark)) return std::nullopt;
    return trim(line.substr(kMark.size()));
}

int misspelt_mark(std::string_view text) {
    int number = 0;
    int found = 0;
    for_each_line(text, [&](std::string_view line) {
        ++number;
        if (line.find('#') == std::string_view::npos) return true;
        const std::string_view rest = trim(line);
        if (!rest.starts_with('#') || is_name(marked(line).value_or(""))) return true;
        const std::string_view bare = trim(rest.substr(1));
        const std::string word(bare.begin(), std::ranges::find_if_not(bare, is_identifier_part));
        if (word.starts_with('p') && nearest(word, {"piece"})) found = number;
        return found == 0;
    });
    return found;
}

int line_before_pieces(std::string_view text) {
    int number = 0;
    int code = 0;
    bool has_mark = false;
    for_each_line(text, [&](std::string_view line) {
        ++number;
        has_mark = marked(line).has_value();
        if (code == 0 && !has_mark && !line.empty() && !line.starts_with("//")) code = number;
        return !has_mark;
    });
    return has_mark ? code : 0;
}

}  // namespace gobo
