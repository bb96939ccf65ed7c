#include "emit/cpp_text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gobo {
namespace {

constexpr std::size_t line_width = 110;
/// MSVC takes 16,380 bytes; what is left is for delimiters.
constexpr std::size_t literal_limit = 16000;
/// An octal escape: the most that one byte can take.
constexpr std::size_t longest_escape = 4;

bool is_plain(char character) {
    return (character >= ' ' && character <= '~') || character == '\n' || character == '\t';
}

bool fits_raw_literal(std::string_view text) {
    return text.find('\n') != std::string_view::npos && std::all_of(text.begin(), text.end(), is_plain);
}

std::string raw_literal(std::string_view text) {
    std::string delimiter = "gobo";
    // At most 16 characters are allowed; a text would have to hold thousands of these to get there.
    for (int number = 2; text.find(")" + delimiter + "\"") != std::string_view::npos; ++number) {
        delimiter = fmt::format("gobo{}", number);
    }
    return fmt::format("R\"{0}({1}){0}\"", delimiter, text);
}

std::string escaped_literal(std::string_view text) {
    std::string literal = "\"";
    for (const char character : text) {
        if (character == '"' || character == '\\') {
            literal += '\\';
            literal += character;
        } else if (character == '\n') {
            literal += "\\n";
        } else if (is_plain(character) && character != '\t' && character != '?') {
            literal += character;
        } else {
            // Three octal digits end by themselves, unlike hexadecimal ones; '?' would start a trigraph.
            literal += fmt::format("\\{:03o}", static_cast<unsigned char>(character));
        }
    }
    return literal + '"';
}

}  // namespace

std::string cpp_literal(std::string_view text) {
    return fits_raw_literal(text) ? raw_literal(text) : escaped_literal(text);
}

std::string cpp_list(const std::vector<std::string>& items) {
    if (items.empty()) return {};
    std::string text = "{";
    std::size_t column = line_width;
    for (const std::string& item : items) {
        if (column + item.size() + 2 > line_width) {
            text += "\n        ";
            column = 8;
        } else {
            text += ' ';
        }
        text += item;
        text += ',';
        column += item.size() + 2;
    }
    text += "\n    }";
    return text;
}

std::vector<std::string_view> cut_for_literals(std::string_view text) {
    const bool raw = fits_raw_literal(text);
    const std::size_t limit = raw ? literal_limit : literal_limit / longest_escape;
    std::vector<std::string_view> parts;
    while (text.size() > limit) {
        const auto line_end = text.rfind('\n', limit - 1);
        const std::size_t size = line_end == std::string_view::npos ? limit : line_end + 1;
        parts.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    if (!text.empty() || parts.empty()) parts.push_back(text);
    return parts;
}

}  // namespace gobo
