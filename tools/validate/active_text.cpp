#include "validate/active_text.hpp"

#include <algorithm>
#include <utility>

#include "compose/clean_text.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/language_rules.hpp"
#include "validate/missing_built_ins.hpp"

namespace gobo {
namespace {

std::string_view trim_left(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

ActiveDirective directive_of(std::string_view text, const Piece& piece, int line) {
    text = trim_left(text);
    const std::string_view word(text.begin(), std::ranges::find_if_not(text, is_identifier_part));
    return {word, trim_left(text.substr(word.size())), &piece, line};
}

void read_lines(std::string_view text, const Piece& piece, ReadPiece& read) {
    for (int number = piece.first_line; !text.empty(); ++number) {
        // Many lines are empty: those of comments.
        const std::size_t empty = std::min(text.find_first_not_of('\n'), text.size());
        number += static_cast<int>(empty);
        text.remove_prefix(empty);
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        std::string_view code = trim_left(line);
        if (code.starts_with('#')) {
            read.directives.push_back(directive_of(code.substr(1), piece, number));
            read.tokens_before.push_back(read.tokens.size());
            continue;
        }
        for (auto token = next_token(code); !token.empty(); token = next_token(code)) {
            const bool is_name = is_identifier_start(token.front());
            read.tokens.push_back({token, &piece, number, is_name, is_name && is_noted(token)});
        }
    }
}

bool may_declare_functions(const ReadPiece& read) {
    const std::vector<Token>& tokens = read.tokens;
    const auto has_end = [](const ActiveDirective& directive) {
        return directive.rest.find(';') != std::string_view::npos;
    };
    if (std::ranges::any_of(read.directives, has_end)) return true;  // of a macro
    int depth = 0;                                                   // of braces
    for (std::size_t i = 0; i < tokens.size() && depth >= 0; ++i) {
        const std::string_view token = tokens[i].text;
        if (token == "{") ++depth;
        if (token == "}") --depth;
        if (depth == 0 && token == ";" && i > 0 && tokens[i - 1].text == ")") return true;
    }
    return depth != 0;  // a function goes on in another piece
}

void add_tokens(ActiveText& found, const ReadPiece& read) {
    std::size_t done = 0;
    const auto add_up_to = [&](std::size_t end) {
        const auto begin = read.tokens.begin();
        if (found.conditions.is_active())
            found.tokens.insert(found.tokens.end(), begin + static_cast<std::ptrdiff_t>(done),
                                begin + static_cast<std::ptrdiff_t>(end));
        done = end;
    };
    for (std::size_t i = 0; i < read.directives.size(); ++i) {
        add_up_to(read.tokens_before[i]);
        const auto& [word, rest, piece, line] = read.directives[i];
        if (found.conditions.is_active()) {
            found.directives.push_back(read.directives[i]);
            found.tokens_before.push_back(found.tokens.size());
        }
        if (word == "define" || word == "undef" || word.starts_with("if") || word.starts_with("el") ||
            word == "endif")
            static_cast<void>(found.conditions.apply({std::string(word), std::string(rest), {}, {}}));
    }
    add_up_to(read.tokens.size());
}

}  // namespace

const ReadPiece& ReadPieces::of(const Piece& piece) {
    const auto [known, is_new] = known_.try_emplace(&piece);
    ReadPiece& read = known->second;
    if (!is_new) return read;
    std::string_view text = piece.text;
    if (text.find("//") != std::string_view::npos || text.find("/*") != std::string_view::npos)
        if (auto clean = clean_text(text, piece.path)) text = read.without_comments = std::move(clean->code);
    read_lines(text, piece, read);
    read.may_declare_functions = gobo::may_declare_functions(read);
    read.differs_from_drivers = gobo::differs_from_drivers(piece.text);
    return read;
}

ActiveText active_text(const std::vector<const Piece*>& pieces, Dialect dialect, ReadPieces& read) {
    ActiveText found(pieces.front()->text, !is_spirv(dialect));
    for (const Piece* const piece : pieces)
        if (piece != pieces.front()) add_tokens(found, read.of(*piece));
    return found;
}

}  // namespace gobo
