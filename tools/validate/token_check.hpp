// What the checks of a stage's tokens share: to read them, and to say what is wrong where.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "validate/active_text.hpp"

namespace gobo {

[[nodiscard]] inline bool is_any(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}
[[nodiscard]] bool is_any(std::string_view word, const auto& words) {
    return std::ranges::find(words, word) != words.end();
}

/// What a class of rules over a stage's tokens is made from. The first of two same messages is kept.
class TokenCheck {
  protected:
    explicit TokenCheck(const ActiveText& text) : text_(text), tokens_(text.tokens) {}

    void say(Severity severity, const Piece& piece, int line, std::string message, std::string help) {
        if (!told_.insert(message).second) return;
        Diagnostic& diagnostic = found_.emplace_back();
        diagnostic.severity = severity;
        diagnostic.message = std::move(message);
        diagnostic.help = std::move(help);
        put_at(diagnostic, piece, line);
    }
    void refuse(const Token& token, std::string message, std::string help) {
        say(Severity::error, *token.piece, token.line, std::move(message), std::move(help));
    }
    void refuse(std::size_t index, std::string message, std::string help) {
        refuse(tokens_[index], std::move(message), std::move(help));
    }

    [[nodiscard]] std::string_view at(std::size_t index) const { return text_.at(index); }
    [[nodiscard]] bool is_name(std::size_t index) const { return text_.is_name(index); }
    [[nodiscard]] bool is_macro(std::size_t index) const { return text_.is_macro(index); }

    /// The first of the words from one token to another; `end` where there is none.
    [[nodiscard]] std::size_t find(std::size_t begin, std::size_t end,
                                   std::initializer_list<std::string_view> words) const {
        while (begin < end && !is_any(at(begin), words)) ++begin;
        return begin;
    }
    /// The `)` or `}` that closes the bracket at a token; `end` where none does.
    [[nodiscard]] std::size_t closing(std::size_t bracket, std::size_t end) const {
        const std::string_view opens = at(bracket);
        const std::string_view closes = opens == "(" ? ")" : "}";
        for (int depth = 0; bracket < end; ++bracket) {
            if (at(bracket) == opens) ++depth;
            if (at(bracket) == closes && --depth == 0) break;
        }
        return bracket;
    }

    const ActiveText& text_;
    const std::vector<Token>& tokens_;
    Diagnostics found_;

  private:
    std::set<std::string> told_;
};

}  // namespace gobo
