#include "validate/missing_ends.hpp"

#include <algorithm>
#include <cctype>
#include <deque>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "compose/clean_text.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// A token of a stage: the number of its piece and its line there.
struct Token {
    std::string_view text;
    std::size_t piece = 0;
    int line = 0;
};

char closing(std::string_view token) {
    return token == "{" ? '}' : token == "(" ? ')' : token == "[" ? ']' : '\0';
}

/// Follows a stage's brackets over all branches of its conditions.
class Brackets {
  public:
    explicit Brackets(const std::vector<const Piece*>& pieces) {
        for (const Piece* piece : pieces) {
            code_.push_back(clean_text(piece->text, piece->path).value_or(CleanText{}).code);
            int line = piece->first_line;
            for (std::string_view rest = code_.back(); !rest.empty(); ++line) {
                const std::string_view text = rest.substr(0, rest.find('\n'));
                read_line(text, code_.size() - 1, line);
                rest.remove_prefix(std::min(text.size() + 1, rest.size()));
            }
        }
    }

    /// All tokens but those of directives.
    [[nodiscard]] const std::vector<Token>& tokens() const { return tokens_; }
    /// The first bracket that nothing closes; nothing where that hangs on conditions or macros.
    [[nodiscard]] std::optional<Token> unclosed() const {
        if (is_open_question_) return std::nullopt;
        if (lost_) return lost_;
        return open_.empty() ? std::nullopt : std::optional(open_.front());
    }

  private:
    void read_line(std::string_view text, std::size_t piece, int line) {
        const std::vector<std::string_view> words = tokens_of(text);
        if (words.empty()) return;
        if (words.front() == "#") return read_directive(words);
        for (const std::string_view word : words) {
            tokens_.push_back({word, piece, line});
            if (closing(word) != '\0') open_.push_back(tokens_.back());
            if (word != "}" && word != ")" && word != "]") continue;
            const auto opens = std::find_if(open_.rbegin(), open_.rend(), [&](const Token& bracket) {
                return closing(bracket.text) == word.front();
            });
            if (opens == open_.rend()) continue;
            if (opens != open_.rbegin() && !lost_) lost_ = *opens.base();
            open_.erase(std::prev(opens.base()), open_.end());
        }
    }

    void read_directive(const std::vector<std::string_view>& words) {
        const std::string_view word = words.size() > 1 ? words[1] : "";
        if (word == "define") {
            const auto count = [&](std::string_view bracket) { return std::ranges::count(words, bracket); };
            is_open_question_ = is_open_question_ || count("{") != count("}") || count("(") != count(")");
        } else if (word.starts_with("if")) {
            branches_.push_back(open_.size());
        } else if (!branches_.empty() && (word == "else" || word == "elif" || word == "endif")) {
            is_open_question_ = is_open_question_ || open_.size() != branches_.back();
            if (word == "endif") branches_.pop_back();
        }
    }

    std::deque<std::string> code_;  ///< tokens point into it
    std::vector<Token> tokens_;
    std::vector<Token> open_;
    std::optional<Token> lost_;          ///< another bracket was closed around it
    std::vector<std::size_t> branches_;  ///< of conditions: how many brackets were open before them
    bool is_open_question_ = false;
};

bool is_number(std::string_view token) {
    return token.find_first_of("0123456789") <= 1;
}

/// Whether a declaration goes on behind the last of its tokens.
bool lacks_semicolon(const std::vector<Token>& tokens) {
    if (tokens.empty() || tokens.back().text == ";") return false;
    if (tokens.back().text != "}") return true;
    int depth = 0;
    for (auto at = tokens.rbegin(); at != tokens.rend(); ++at) {
        if (at->text == "}") ++depth;
        if (at->text != "{" || --depth > 0) continue;
        return std::next(at) != tokens.rend() &&
               std::next(at)->text != ")";  // no function: a struct, a block
    }
    return false;
}

/// Whether glslang's "unexpected IDENTIFIER, expecting COMMA or SEMICOLON" may mean the token.
bool is_unexpected(std::string_view message, std::string_view token) {
    constexpr std::string_view kUnexpected = "syntax error, unexpected ";
    const std::size_t at = message.find(kUnexpected);
    if (at == std::string_view::npos || !message.ends_with("expecting COMMA or SEMICOLON")) return false;
    const std::string_view rest = message.substr(at + kUnexpected.size());
    const std::string_view name = rest.substr(0, rest.find(','));
    if (token == "}") return name == "RIGHT_BRACE";
    if (!is_identifier(token)) return false;
    const bool is_keyword = std::ranges::equal(name, token, [](char upper, char lower) {
        return upper == std::toupper(static_cast<unsigned char>(lower));
    });
    return is_keyword || name == "IDENTIFIER" || name == "TYPE_NAME";
}

/// Whether the last of the tokens may end a statement or a declaration that lacks its `;`.
bool may_lack_semicolon(const std::vector<Token>& tokens) {
    if (tokens.empty()) return false;
    const std::string_view last = tokens.back().text;
    if (last == "else" || last == "do") return false;
    if (last != ")" && last != "]" && last != "}") return is_identifier(last) || is_number(last);
    int depth = 0;  // of what the last token closes
    for (auto at = tokens.rbegin(); at != tokens.rend(); ++at) {
        if (at->text == "}" || at->text == ")" || at->text == "]") ++depth;
        if (closing(at->text) == '\0' || --depth > 0) continue;
        if (std::next(at) == tokens.rend()) return false;
        const std::string_view head = std::next(at)->text;
        if (last == ")") return head != "if" && head != "for" && head != "while" && head != "switch";
        return last == "]" || head == "=" || (is_identifier(head) && head != "else" && head != "do");
    }
    return false;
}

}  // namespace

Diagnostics with_missing_ends(Diagnostics found, const std::vector<const Piece*>& pieces) {
    const auto first = std::ranges::find(found, Severity::error, &Diagnostic::severity);
    if (first == found.end()) return found;
    const Brackets brackets(pieces);
    const std::vector<Token>& tokens = brackets.tokens();
    const auto path_of = [&](const Token& token) { return pieces[token.piece]->path; };
    // Where the first error stands; behind all tokens where glslang met the end.
    auto at = std::ranges::find_if(tokens, [&](const Token& token) {
        return token.line == first->place.line && path_of(token) == first->place.file;
    });
    const auto blame = [&](const Token& token, std::string message, std::string help) {
        found.erase(first, found.end());
        const Diagnostics blamed =
            fail({path_of(token), token.line, 0}, line_of(*pieces[token.piece], token.line),
                 std::move(message), std::move(help))
                .value();
        found.insert(found.end(), blamed.begin(), blamed.end());
        return found;
    };
    const auto last_of = [&](const std::string& path) {
        return *std::find_if(tokens.rbegin(), tokens.rend(),
                             [&](const Token& token) { return path_of(token) == path; });
    };
    if (const std::optional<Token> open = brackets.unclosed()) {
        const auto opens = std::ranges::find_if(
            tokens, [&](const Token& token) { return token.text.data() == open->text.data(); });
        if (opens < at && (at == tokens.end() || path_of(*at) != path_of(*open)))
            return blame(last_of(path_of(*open)),
                         fmt::format("a '{}' is missing: nothing closes the '{}' of line {}",
                                     closing(open->text), open->text, open->line),
                         "close it in the same file");
    }
    const std::vector<Token> before(tokens.begin(), at);
    const bool is_first = at == tokens.end() || (!before.empty() && path_of(before.back()) != path_of(*at));
    const bool is_syntax = first->message.find("syntax error") != std::string::npos;
    if (is_syntax && is_first && lacks_semicolon(before))
        return blame(last_of(path_of(before.back())), "a ';' is missing behind the last declaration",
                     "end it in the same file");
    if (at != tokens.end() && !is_first && is_unexpected(first->message, at->text) &&
        may_lack_semicolon(before))
        return blame(before.back(), fmt::format("a ';' is missing behind '{}'", before.back().text),
                     fmt::format("end it before the '{}' of line {}", at->text, at->line));
    return found;
}

}  // namespace gobo
