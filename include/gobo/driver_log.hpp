// An OpenGL driver's compile log in terms of the pieces a stage is made of. No OpenGL.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <gobo/permutation.hpp>

namespace gobo::runtime {

/// A line of a file; an empty name where there is none.
struct FileLine {
    std::string_view name;
    int line = 0;
};

/// Where line `line` (from 1) of string number `string` (from 0) of a stage comes from. Drivers either count
/// within each string, as GLSL demands, or (Mesa) call all strings number 0 and count lines over the whole
/// source; for number 0 the two agree as far as the first piece goes.
template <class Tables>
[[nodiscard]] FileLine locate(const Stage<Tables>& stage, int string, int line) {
    if (string < 0 || string >= stage.piece_count() || line < 1) return {};
    int lines_before = 0;
    for (int position = string; position < stage.piece_count(); ++position) {
        const Piece& piece = stage.piece(position);
        const auto ends = static_cast<int>(std::count(piece.text.begin(), piece.text.end(), '\n'));
        const bool is_here = line <= lines_before + ends || position + 1 == stage.piece_count();
        if (string > 0 || is_here) return {piece.name, piece.first_line + line - lines_before - 1};
        lines_before += ends;
    }
    return {};
}

namespace detail {

/// Reads a whole number at `position`, which moves behind it; -1 where there is none or one of more than 8
/// digits.
inline int read_number(std::string_view text, std::size_t& position) {
    const std::size_t begin = position;
    int number = 0;
    while (position < text.size() && text[position] >= '0' && text[position] <= '9' && position - begin < 9) {
        if (position - begin == 8) return -1;
        number = number * 10 + (text[position] - '0');
        ++position;
    }
    return position > begin ? number : -1;
}

/// One line of a log with its place translated.
template <class Tables>
[[nodiscard]] std::string translated_line(const Stage<Tables>& stage, std::string_view line) {
    std::size_t begin = 0;
    for (const std::string_view prefix : {std::string_view("ERROR: "), std::string_view("WARNING: ")}) {
        if (line.substr(0, prefix.size()) == prefix) begin = prefix.size();
    }
    std::size_t position = begin;
    const int string = read_number(line, position);
    if (string < 0 || position >= line.size()) return std::string(line);
    const bool bracketed = line[position] == '(';
    if (!bracketed && line[position] != ':') return std::string(line);
    ++position;
    const FileLine place = locate(stage, string, read_number(line, position));
    if (place.name.empty()) return std::string(line);
    if (bracketed && position < line.size() && line[position] == ')') ++position;
    return std::string(line.substr(0, begin)) + std::string(place.name) + ":" + std::to_string(place.line) +
           std::string(line.substr(position));
}

}  // namespace detail

/// The log with each place `STRING:LINE` (Mesa, AMD, Intel) or `STRING(LINE)` (NVIDIA) at the start of a
/// message replaced by `FILE:LINE`. Lines without one stay as they are.
template <class Tables>
[[nodiscard]] std::string translated_log(const Stage<Tables>& stage, std::string_view log) {
    std::string text;
    while (!log.empty()) {
        const std::size_t end = log.find('\n');
        text += detail::translated_line(stage, log.substr(0, end));
        if (end == std::string_view::npos) break;
        text += '\n';
        log.remove_prefix(end + 1);
    }
    return text;
}

}  // namespace gobo::runtime
