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

std::string place_text(const Place& place) {
    if (place.file.empty()) return "gobo";
    const std::string file = one_line(place.file);
    if (place.line <= 0) return file;
    const std::string text = fmt::format("{}:{}", file, place.line);
    return place.column > 0 ? fmt::format("{}:{}", text, place.column) : text;
}

/// The quoted line and, where the column is known, a caret below it; tabs are kept so that the caret stands
/// right.
std::string quotation(const Diagnostic& diagnostic) {
    std::string text = fmt::format("    {}\n", one_line(diagnostic.quoted_line));
    const auto column = static_cast<std::size_t>(std::max(diagnostic.place.column, 0));
    if (column == 0 || column > diagnostic.quoted_line.size() + 1) return text;
    text += "    ";
    for (std::size_t i = 0; i + 1 < column; ++i) text += diagnostic.quoted_line[i] == '\t' ? '\t' : ' ';
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

std::string to_text(const Diagnostic& diagnostic, bool color) {
    const auto severity = static_cast<std::size_t>(diagnostic.severity);
    std::string text =
        fmt::format("{}: {}{}:{} {}", place_text(diagnostic.place), color ? kColors[severity] : "",
                    kNames[severity], color ? "\033[0m" : "", printable(diagnostic.message));
    if (!diagnostic.subject.empty()) text += fmt::format(" [{}]", one_line(diagnostic.subject));
    text += '\n';
    if (!diagnostic.quoted_line.empty()) text += quotation(diagnostic);
    if (!diagnostic.help.empty()) text += fmt::format("  help: {}\n", printable(diagnostic.help));
    return text;
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
