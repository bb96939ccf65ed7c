// The lines that part a file into pieces.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

namespace gobo {

/// The name behind `#piece`, where the line is such a mark.
[[nodiscard]] std::optional<std::string_view> marked(std::string_view line);

/// The first line that was meant to mark a piece, but does not: `#pieces a`, ` #piece a`, `#piece`; 0 where
/// there is none.
[[nodiscard]] int misspelt_mark(std::string_view text);

/// The first line of code before the first mark of a file; 0 where there is none, or no mark.
[[nodiscard]] int line_before_pieces(std::string_view text);

/// Calls visit(line) for each, its end left out, until it answers false.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        if (!visit(text.substr(start, end - start))) return;
        start = end + 1;
    }
}

}  // namespace gobo
