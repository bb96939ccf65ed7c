#include "core/text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gobo {
namespace {

/// Damerau-Levenshtein distance with adjacent transpositions (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            distance[i][j] = i + j;
            if (i == 0 || j == 0) continue;
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            distance[i][j] =
                std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
        }
    }
    return distance.back().back();
}

/// How many bytes the first character takes; 0 where it is no UTF-8.
std::size_t character_length(std::string_view text) {
    const auto byte = static_cast<unsigned char>(text.front());
    const std::size_t length = byte < 0x80   ? 1
                               : byte < 0xC2 ? 0
                               : byte < 0xE0 ? 2
                               : byte < 0xF0 ? 3
                               : byte < 0xF5 ? 4
                                             : 0;
    if (length > text.size()) return 0;
    for (const char further : text.substr(1, std::max(length, std::size_t{1}) - 1))
        if ((static_cast<unsigned char>(further) & 0xC0) != 0x80) return 0;
    return length;
}

/// Whether a terminal obeys the character instead of showing it, tabs and line ends left aside: controls, and
/// marks that turn the direction of what follows.
bool is_control(std::string_view character) {
    const auto byte = static_cast<unsigned char>(character.front());
    if (character.size() == 1) return byte == 0x7F || (byte < ' ' && byte != '\t' && byte != '\n');
    const auto last = static_cast<unsigned char>(character.back());
    if (byte == 0xC2) return last < 0xA0;   // U+0080 to U+009F
    if (character.starts_with("\xE2\x80"))  // U+200E, U+200F, U+2028 to U+202E
        return last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE);
    return character.starts_with("\xE2\x81") && last >= 0xA6 && last <= 0xA9;  // U+2066 to U+2069
}

/// Names longer than this are not looked for among others: each comparison takes time by both lengths.
constexpr std::size_t kLongestName = 200;

}  // namespace

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\f\v";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool has_empty_part(std::string_view text, char separator) {
    const auto parts = std::ranges::count(text, separator) + 1;
    return std::ssize(split(text, separator)) < parts;
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (true) {
        const auto end = text.find(separator);
        const std::string_view part = trim(text.substr(0, end));
        if (!part.empty()) parts.emplace_back(part);
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::string join(const std::vector<std::string>& parts, std::string_view separator) {
    return fmt::format("{}", fmt::join(parts, separator));
}

std::optional<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates) {
    if (name.size() > kLongestName) return std::nullopt;
    std::optional<std::string> best;
    std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        if (name.size() >= candidate.size() + best_distance ||
            candidate.size() >= name.size() + best_distance)
            continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (distance >= best_distance) continue;
        best_distance = distance;
        best = candidate;
    }
    return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
    if (const auto near = nearest(name, candidates)) return fmt::format("did you mean '{}'?", *near);
    if (candidates.empty()) return "there are none";
    return fmt::format("known: {}", fmt::join(candidates, ", "));
}

std::optional<std::pair<std::size_t, std::size_t>> pair_from(std::string_view text, char separator) {
    const auto at = text.find(separator);
    if (at == std::string_view::npos) return std::nullopt;
    const auto first = number_from<std::size_t>(text.substr(0, at));
    const auto second = number_from<std::size_t>(text.substr(at + 1));
    return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

bool is_identifier(std::string_view text) {
    return !text.empty() && is_identifier_start(text.front()) &&
           std::all_of(text.begin(), text.end(), is_identifier_part);
}

std::string without_subscripts(std::string_view name) {
    std::string text;
    bool is_inside = false;
    for (const char character : name) {
        if (character == ']') is_inside = false;
        if (!is_inside) text += character;
        if (character == '[') is_inside = true;
    }
    return text;
}

std::string folder_of(std::string_view path) {
    const auto slash = path.rfind('/');
    return slash == std::string_view::npos ? ""
                                           : std::string(path.substr(0, std::max(slash, std::size_t{1})));
}

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0 || is_control(text.substr(0, length)))
            result += '?';
        else
            result += text.substr(0, length);
        text.remove_prefix(std::max(length, std::size_t{1}));
    }
    return result;
}

std::string one_line(std::string_view text) {
    std::string line = printable(text);
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

std::string short_number(double number) {
    if (number != 0 && (std::abs(number) < 1e-3 || std::abs(number) >= 1e6))
        return fmt::format("{:.1e}", number);
    return std::abs(number) >= 999.5 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
}

}  // namespace gobo
