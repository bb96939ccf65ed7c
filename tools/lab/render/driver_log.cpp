#include "lab/render/driver_log.hpp"

#include <algorithm>
#include <regex>

#include "core/text.hpp"

namespace gobo {
namespace {

int line_ends(std::string_view text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// The piece that holds line `line` (from 1) of string number `string` (from 0) as a driver counts them;
/// `line` becomes the piece's own. Null where there is none.
const Piece* piece_at(const std::vector<Piece>& pieces, int string, int& line) {
    if (string > 0) return string < static_cast<int>(pieces.size()) ? &pieces[string] : nullptr;
    for (const Piece& piece : pieces) {
        const int ends = line_ends(piece.text);
        if (line <= ends || &piece == &pieces.back()) return &piece;
        line -= ends;
    }
    return nullptr;
}

struct LogLine {
    int string = 0;
    int line = 0;
    std::string severity;
    std::string message;
};

int number(const std::ssub_match& match) {
    return match.matched ? std::stoi(match.str()) : 0;
}

bool read_log_line(const std::string& text, LogLine& result) {
    static const std::regex mesa(R"((\d{1,8}):(\d{1,8})\(\d{1,8}\): (error|warning): (.*))");
    static const std::regex nvidia(R"((\d{1,8})\((\d{1,8})\) : (error|warning) (.*))");
    static const std::regex others(R"((ERROR|WARNING): (\d{1,8}):(\d{1,8}): (.*))");
    std::smatch match;
    if (std::regex_match(text, match, mesa)) {
        result = {number(match[1]), number(match[2]), match[3], match[4]};
    } else if (std::regex_match(text, match, nvidia)) {
        result = {number(match[1]), number(match[2]), match[3], match[4]};
    } else if (std::regex_match(text, match, others)) {
        result = {number(match[2]), number(match[3]), match[1] == "ERROR" ? "error" : "warning", match[4]};
    } else {
        return false;
    }
    return true;
}

/// A message without a place, as linkers give them: `error: text` or `warning: text`.
Diagnostic without_place(std::string_view text) {
    Diagnostic diagnostic;
    for (const auto& [prefix, severity] : {std::pair(std::string_view("error: "), Severity::error),
                                           std::pair(std::string_view("warning: "), Severity::warning)}) {
        if (!text.starts_with(prefix)) continue;
        diagnostic.severity = severity;
        text.remove_prefix(prefix.size());
    }
    diagnostic.message = text;
    return diagnostic;
}

}  // namespace

Diagnostics diagnostics_of_log(std::string_view log, const StageText& stage) {
    Diagnostics diagnostics;
    for (const std::string_view text : split(log, '\n')) {
        Diagnostic diagnostic;
        LogLine line;
        if (!read_log_line(std::string(text), line)) {
            diagnostics.push_back(without_place(text));
            continue;
        }
        diagnostic.severity = line.severity == "error" ? Severity::error : Severity::warning;
        diagnostic.message = line.message;
        if (const Piece* piece = piece_at(stage.pieces, line.string, line.line)) {
            diagnostic.place = {piece->path, line.line, 0};
            diagnostic.quoted_line = line_of(*piece, line.line);
        }
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

}  // namespace gobo
