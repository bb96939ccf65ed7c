#include "compose/clean_text.hpp"

#include <algorithm>

namespace gobo {
namespace {

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t") == std::string_view::npos;
}

/// The text with lines joined. Their ends stand behind the whole line.
struct JoinedText {
    std::string text;
    std::vector<std::size_t> joins;  ///< where in `text` a line end was taken out
    std::vector<std::size_t> ends;   ///< of its lines

    /// Whether a `//` comment takes in more than blanks and another such comment.
    [[nodiscard]] bool takes_in_code(std::size_t begin, std::size_t end) const {
        const auto next = std::ranges::upper_bound(joins, begin);
        if (next == joins.end() || *next >= end) return false;
        const std::string_view taken = std::string_view(text).substr(*next, end - *next);
        return !is_blank(taken) && !taken.substr(taken.find_first_not_of(" \t")).starts_with("//");
    }
    /// The line of the file that a character stands on.
    [[nodiscard]] int line_at(std::size_t at) const {
        const auto end = std::ranges::lower_bound(ends, at);
        const std::size_t start = end == ends.begin() ? 0 : end[-1] + 1;
        return static_cast<int>(
            1 + (end - ends.begin()) +
            (std::ranges::upper_bound(joins, at) - std::ranges::lower_bound(joins, start)));
    }
};

JoinedText join_lines(std::string_view text) {
    JoinedText joined;
    std::size_t owed = 0;
    const auto put_end = [&] {
        joined.ends.push_back(joined.text.size());
        joined.text += '\n';
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i).starts_with("\\\n")) {
            joined.joins.push_back(joined.text.size());
            ++owed;
            ++i;
            continue;
        }
        if (text[i] != '\n') {
            joined.text += text[i];
            continue;
        }
        for (put_end(); owed > 0; --owed) put_end();
    }
    joined.text.append(owed, '\n');
    return joined;
}

/// Cuts the comments of a text whose lines are joined.
class CommentCutter {
  public:
    explicit CommentCutter(const JoinedText& joined) : joined_(joined) {}

    Result<CleanText> run(const std::string& path, std::string_view file) {
        const std::string_view text = joined_.text;
        for (std::size_t i = 0; i < text.size();) {
            if (text.substr(i).starts_with("//")) {
                const std::size_t end = text.find('\n', i);
                if (joined_.takes_in_code(i, end)) clean_.joined_comments.push_back(joined_.line_at(i));
                i = cut(i, end);
            } else if (text.substr(i).starts_with("/*")) {
                const std::size_t close = text.find("*/", i + 2);
                if (close == std::string_view::npos) {
                    const int line = joined_.line_at(i);
                    return fail({path, line, 0}, line_of(file, line), "a comment has no end",
                                "close it with */");
                }
                i = cut(i, close + 2);
            } else {
                put(text[i], text[i]);
                if (text[i++] == '\n') end_line();
            }
        }
        return std::move(clean_);
    }

  private:
    void put(char text, char code) {
        clean_.text += text;
        clean_.code += code;
        if (!has_code_) is_directive_ = code == '#';
        has_code_ = has_code_ || (code != ' ' && code != '\t');
        has_quotation_ = has_quotation_ || code == '"';
        if (code == '\n') has_code_ = has_quotation_ = false;
    }
    void end_line() {
        for (; owed_ > 0; --owed_) put('\n', '\n');
    }

    /// Cuts the comment from `begin` to `end`, which is returned.
    std::size_t cut(std::size_t begin, std::size_t end) {
        const std::string_view comment = std::string_view(joined_.text).substr(begin, end - begin);
        // Amid a directive, or where one would begin, a comment is a blank, however many lines it takes.
        if (has_code_ && comment.find('\n') != std::string_view::npos && is_directive_around(end)) {
            owed_ += std::ranges::count(comment, '\n');
            put(' ', ' ');
            return end;
        }
        // To glslang what stands behind a quotation mark is a string, to others it may be a comment.
        const bool is_disputed = has_quotation_;
        for (const char character : comment)
            put(is_disputed && character != '\n' ? ' ' : character, character == '\n' ? '\n' : ' ');
        return end;
    }

    /// Whether the current line is a directive that goes on behind a comment, or what goes on looks like one.
    [[nodiscard]] bool is_directive_around(std::size_t end) const {
        const std::string_view text = joined_.text;
        const std::string_view behind = text.substr(end, text.find('\n', end) - end);
        return !is_blank(behind) && (is_directive_ || behind[behind.find_first_not_of(" \t")] == '#');
    }

    const JoinedText& joined_;
    CleanText clean_;
    std::ptrdiff_t owed_ = 0;  ///< line ends of comments amid the current line
    bool has_code_ = false;    ///< the current line, so far
    bool is_directive_ = false;
    bool has_quotation_ = false;
};

}  // namespace

std::string unix_lines(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    // Nearly every file, and each is read once for each of its pieces.
    if (std::ranges::all_of(std::string_view("\r\v\f"),
                            [&](char odd) { return text.find(odd) == std::string_view::npos; }))
        return std::string(text);
    std::string lines;
    lines.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view pair = text.substr(i, 2);
        if (pair == "\r\n" || pair == "\n\r") ++i;
        // Vertical tabs and form feeds are blanks in GLSL, which not every reader knows.
        const char character = pair.front();
        lines += character == '\r' ? '\n' : character == '\v' || character == '\f' ? ' ' : character;
    }
    return lines;
}

Result<CleanText> clean_text(std::string_view text, const std::string& path) {
    std::string lines = unix_lines(text);
    if (const auto nul = lines.find('\0'); nul != std::string::npos) {
        const auto line =
            1 + std::count(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
        return fail({path, static_cast<int>(line), 0}, "", "holds a NUL byte and is not text",
                    "name a GLSL file");
    }
    if (!lines.empty() && lines.back() != '\n') lines += '\n';
    return CommentCutter(join_lines(lines)).run(path, lines);
}

std::string without_trailing_blanks(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const std::string_view kept = line.substr(0, line.find_last_not_of(" \t") + 1);
        result += kept;
        result += kept.ends_with('\\') ? " \n" : "\n";
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return result;
}

}  // namespace gobo
