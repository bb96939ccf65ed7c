#include "validate/glslang_log.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// A message's head: which piece and line it names, and what is left of it.
struct Head {
    const Piece* piece;
    int line;
    std::string_view rest;
};

/// `path:12: rest` for one of the pieces. Paths may hold colons, so they are compared, not searched for.
std::optional<Head> head_of(std::string_view message, const std::vector<const Piece*>& pieces) {
    for (const Piece* piece : pieces) {
        if (!message.starts_with(piece->path)) continue;
        std::string_view rest = message.substr(piece->path.size());
        int line = 0;
        if (!rest.starts_with(':')) continue;
        const auto parsed = std::from_chars(rest.data() + 1, rest.data() + rest.size(), line);
        rest.remove_prefix(static_cast<std::size_t>(parsed.ptr - rest.data()));
        if (parsed.ec != std::errc{} || !rest.starts_with(':')) continue;
        return Head{piece, line, trim(rest.substr(1))};
    }
    return std::nullopt;
}

constexpr std::string_view given_up = "'' : compilation terminated";

/// glslang closes a log with counts, with what it will not do and that it stops; these say nothing of their
/// own.
bool says_nothing(std::string_view message) {
    return message.ends_with("No code generated.") || message.find(given_up) != std::string_view::npos ||
           message.find(" compilation errors.") != std::string_view::npos;
}

/// Takes one severity word off the front of a line.
std::optional<Severity> take_severity(std::string_view& line) {
    if (line.starts_with("ERROR: ")) return line.remove_prefix(7), Severity::error;
    if (line.starts_with("WARNING: ")) return line.remove_prefix(9), Severity::warning;
    return std::nullopt;
}

Diagnostic diagnostic_of(Severity severity, std::string_view message, const std::vector<const Piece*>& pieces,
                         const Place& otherwise) {
    Diagnostic diagnostic;
    diagnostic.severity = severity;
    const auto head = head_of(message, pieces);
    diagnostic.message = head ? head->rest : message;
    diagnostic.place = otherwise;
    if (!head) return diagnostic;
    diagnostic.place = {head->piece->path, head->line, 0};
    // A generated piece carries the lines of the file it comes from only where it stands for one.
    diagnostic.quoted_line = line_of(*head->piece, head->line);
    return diagnostic;
}

}  // namespace

Diagnostics diagnostics_of_log(std::string_view log, const std::vector<const Piece*>& pieces,
                               const Place& otherwise) {
    Diagnostics diagnostics;
    // Where glslang gives up, every condition that is open seems to lack its end.
    const bool gave_up = log.find(given_up) != std::string_view::npos;
    while (!log.empty()) {
        const auto end = std::min(log.find('\n'), log.size());
        std::string_view line = log.substr(0, end);
        log.remove_prefix(std::min(end + 1, log.size()));
        const auto severity = take_severity(line);
        if (trim(line).empty() || says_nothing(line)) continue;
        if (gave_up && line.find("'' : missing #endif") != std::string_view::npos) continue;
        if (severity) {
            diagnostics.push_back(diagnostic_of(*severity, trim(line), pieces, otherwise));
        } else if (!diagnostics.empty()) {  // a message that goes on
            diagnostics.back().message += fmt::format(" {}", trim(line));
        }
    }
    return diagnostics;
}

}  // namespace gobo
