#include "validate/active_text.hpp"

#include <algorithm>
#include <utility>

#include "compose/clean_text.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

std::string_view trim_left(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

void add_directive(ActiveText& found, ActiveDirective directive) {
    const std::string_view text = trim_left(directive.rest);
    directive.word = {text.begin(), std::ranges::find_if_not(text, is_identifier_part)};
    directive.rest = trim_left(text.substr(directive.word.size()));
    if (found.conditions.is_active()) found.directives.push_back(directive);
    const std::string_view word = directive.word;
    if (word == "define" || word == "undef" || word.starts_with("if") || word.starts_with("el") ||
        word == "endif")
        static_cast<void>(found.conditions.apply({std::string(word), std::string(directive.rest), {}, {}}));
}

void add_piece(ActiveText& found, const Piece& piece) {
    std::string_view text = piece.text;
    if (text.find("//") != std::string_view::npos || text.find("/*") != std::string_view::npos)
        if (auto clean = clean_text(text, piece.path))
            text = found.without_comments.emplace_back(std::move(clean->code));
    for (int number = 1; !text.empty(); ++number) {
        // Most lines are empty: those of the file that stand before the piece.
        const std::size_t empty = std::min(text.find_first_not_of('\n'), text.size());
        number += static_cast<int>(empty);
        text.remove_prefix(empty);
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::string_view code = trim_left(line);
        if (code.empty()) continue;
        if (code.front() == '#') {
            add_directive(found, {{}, code.substr(1), &piece, number});
        } else if (found.conditions.is_active()) {
            std::string_view rest = code;
            for (auto token = next_token(rest); !token.empty(); token = next_token(rest))
                found.tokens.push_back({token, &piece, number});
        }
    }
}

}  // namespace

ActiveText active_text(const std::vector<const Piece*>& pieces, Dialect dialect) {
    ActiveText found(pieces.front()->text, !is_spirv(dialect));
    for (const Piece* const piece : pieces)
        if (piece != pieces.front()) add_piece(found, *piece);
    return found;
}

}  // namespace gobo
