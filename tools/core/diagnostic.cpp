#include "core/diagnostic.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

// By Severity.
constexpr std::array kNames = {"error", "warning", "note"};
constexpr std::array kColors = {"\033[1;31m", "\033[1;35m", "\033[1;36m"};

/// The exit statuses, by Fault.
constexpr std::array kStatuses = {1, 2, 3, 3, 4};

/// Bytes of each part of a message: what it quotes may be a whole file.
constexpr std::size_t kLongestMessage = 1500;
constexpr std::size_t kLongestHelp = 3000;
constexpr std::size_t kLongestName = 400;
constexpr std::size_t kLongestLine = 240;

/// Where a character of UTF-8 begins, at `at` or before.
std::size_t whole_characters(std::string_view text, std::size_t at) {
    while (at > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) --at;
    return at;
}

/// The beginning and the end of a text that is too long.
std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    const std::size_t begin = whole_characters(text, most * 3 / 4);
    const std::size_t end = whole_characters(text, text.size() - most / 4);
    return fmt::format("{} [... {} bytes ...] {}", text.substr(0, begin), end - begin, text.substr(end));
}

std::string place_text(const Place& place) {
    if (place.file.empty()) return "gobo";
    const std::string file = one_line(shortened(place.file, kLongestName));
    if (place.line <= 0) return file;
    const std::string text = fmt::format("{}:{}", file, place.line);
    return place.column > 0 ? fmt::format("{}:{}", text, place.column) : text;
}

/// The quoted line, of a long one the part around the column, and where the column is known a caret below it;
/// tabs are kept so that the caret stands right.
std::string quotation(const Diagnostic& diagnostic) {
    std::string_view line = diagnostic.quoted_line;
    auto column = static_cast<std::size_t>(std::max(diagnostic.place.column, 0));
    if (column > line.size() + 1) column = 0;
    const char* before = "";
    const char* behind = "";
    if (line.size() > kLongestLine) {
        const std::size_t start =
            whole_characters(line, column > kLongestLine / 2 ? column - kLongestLine / 2 : 0);
        const std::size_t end = whole_characters(line, std::min(start + kLongestLine, line.size()));
        if (start > 0) before = "...";
        if (end < line.size()) behind = "...";
        if (column > 0) column -= start;
        line = line.substr(start, end - start);
    }
    std::string text = fmt::format("    {}{}{}\n", before, one_line(line), behind);
    if (column == 0) return text;
    text += fmt::format("    {:{}}", "", std::string_view(before).size());
    for (std::size_t i = 0; i + 1 < column; ++i) text += line[i] == '\t' ? '\t' : ' ';
    return text + "^\n";
}

}  // namespace

tl::unexpected<Diagnostics> fail(Fault fault, std::string message, std::string help) {
    return fail({.fault = fault, .message = std::move(message), .help = std::move(help)});
}

tl::unexpected<Diagnostics> fail(Diagnostic diagnostic) {
    return tl::unexpected(Diagnostics{std::move(diagnostic)});
}

tl::unexpected<Diagnostics> fail(const Place& place, std::string_view quoted_line, std::string message,
                                 std::string help) {
    return fail({.place = place,
                 .message = std::move(message),
                 .quoted_line = std::string(quoted_line),
                 .help = std::move(help)});
}

std::string subject_text(const Diagnostic& diagnostic) {
    const std::string subject = one_line(shortened(diagnostic.subject, kLongestName));
    if (diagnostic.more_keys == 0) return subject;
    return fmt::format("{}, and {} more key{}", subject, diagnostic.more_keys,
                       diagnostic.more_keys == 1 ? "" : "s");
}

std::string to_text(const Diagnostic& diagnostic, bool color) {
    const auto severity = static_cast<std::size_t>(diagnostic.severity);
    std::string text = fmt::format("{}: {}{}:{} {}", place_text(diagnostic.place),
                                   color ? kColors[severity] : "", kNames[severity], color ? "\033[0m" : "",
                                   one_line(shortened(diagnostic.message, kLongestMessage)));
    if (!diagnostic.subject.empty()) text += fmt::format(" [{}]", subject_text(diagnostic));
    text += '\n';
    if (!diagnostic.quoted_line.empty()) text += quotation(diagnostic);
    if (!diagnostic.help.empty())
        text += fmt::format("  help: {}\n", one_line(shortened(diagnostic.help, kLongestHelp)));
    return text;
}

std::string to_text(const Diagnostics& diagnostics, bool color) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += to_text(diagnostic, color);
    return text;
}

void append(Diagnostics& diagnostics, const Diagnostics& more) {
    diagnostics.insert(diagnostics.end(), more.begin(), more.end());
}

int exit_status(const Diagnostics& diagnostics) {
    int status = 0;
    for (const Diagnostic& diagnostic : diagnostics)
        if (diagnostic.severity == Severity::error)
            status = std::max(status, kStatuses[static_cast<std::size_t>(diagnostic.fault)]);
    return status;
}

std::string_view line_of(std::string_view text, int number) {
    for (; number > 1; --number) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    if (number < 1) return {};
    text = text.substr(0, text.find('\n'));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

}  // namespace gobo
