// Small text functions that every stage may use.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gobo {

/// `text` without the blanks at both ends.
[[nodiscard]] std::string_view trim(std::string_view text);

/// Whether split() leaves out a part, as of "a,,b" and of "a,".
[[nodiscard]] bool has_empty_part(std::string_view text, char separator);

/// The parts of `text` between `separator`, trimmed; empty ones are left out.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// The parts put together with `separator` between them.
[[nodiscard]] std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// The candidate with the fewest edits from `name`, if it is near enough to be what was meant
/// (at most a third of its letters, at least one); the first in order on a tie.
[[nodiscard]] std::optional<std::string> nearest(std::string_view name,
                                                 const std::vector<std::string>& candidates);

/// "did you mean 'X'?" for the nearest candidate; otherwise "known: A, B, C".
[[nodiscard]] std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// The number that the whole text is, in decimal; nothing where it is none, or none that the type holds.
template <class Number>
[[nodiscard]] std::optional<Number> number_from(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}
/// Two whole numbers with `separator` between them, as "640x480" or "2/4"; nothing where it is not that.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> pair_from(std::string_view text,
                                                                           char separator);

/// [A-Za-z_][A-Za-z0-9_]*
[[nodiscard]] bool is_identifier(std::string_view text);
[[nodiscard]] constexpr bool is_identifier_start(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           character == '_';
}
[[nodiscard]] constexpr bool is_identifier_part(char character) {
    return is_identifier_start(character) || (character >= '0' && character <= '9');
}

/// The name with every subscript emptied: "PointLights.lights[].position".
[[nodiscard]] std::string without_subscripts(std::string_view name);

/// The folder of a path, without the slash at its end ("/" alone keeps it); empty where it names none.
[[nodiscard]] std::string folder_of(std::string_view path);

/// The text with '?' for control characters other than tabs and line ends: a terminal would obey them.
[[nodiscard]] std::string printable(std::string_view text);
/// The same on one line, for comments that a line end closes.
[[nodiscard]] std::string one_line(std::string_view text);

/// A number for readers: three significant digits, and all of those before the point; no exponent where it
/// can do without.
[[nodiscard]] std::string short_number(double number);

}  // namespace gobo
