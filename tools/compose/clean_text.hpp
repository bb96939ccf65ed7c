// A shader file in the one form that every reader of GLSL understands alike.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// The text without byte order mark, each line ended by one `\n`: CR, CR LF and LF CR end a line as well.
[[nodiscard]] std::string unix_lines(std::string_view text);

/// A file whose lines that end in `\` are joined to the next ones, then its comments cut, as GLSL does it.
/// What is joined away leaves empty lines behind, so that line numbers stay; both texts end in a newline, and
/// have the same characters at the same places.
struct CleanText {
    std::string text;  ///< with its comments, but for those that a reader could take for something else
    std::string code;  ///< with blanks for comments
    std::vector<int> joined_comments;  ///< lines of `//` comments that take in the line behind them
};

/// Errors: a comment without an end, a NUL byte.
[[nodiscard]] Result<CleanText> clean_text(std::string_view text, const std::string& path);

/// Without the blanks at the ends of lines. Behind a `\` one stays: the next line would be joined otherwise.
[[nodiscard]] std::string without_trailing_blanks(std::string_view text);

}  // namespace gobo
