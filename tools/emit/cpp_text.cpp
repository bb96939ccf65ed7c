#include "emit/cpp_text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/text.hpp"
#include "emit/reserved_names.hpp"

namespace gobo {
namespace {

constexpr std::size_t kLineWidth = 110;
/// MSVC takes 16,380 bytes; what is left is for delimiters.
constexpr std::size_t kLiteralLimit = 16000;
/// An octal escape: the most that one byte can take.
constexpr std::size_t kLongestEscape = 4;

bool is_plain(char character) {
    return (character >= ' ' && character <= '~') || character == '\n' || character == '\t';
}

/// Whether a line ends in what joins lines, blanks behind it or not: compilers warn of it in raw literals
/// too, some of them of the trigraph.
bool has_joining_end(std::string_view text) {
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1)) {
        const std::string_view line = text.substr(0, text.find_last_not_of(" \t", end - 1) + 1);
        if (end > 0 && (line.ends_with('\\') || line.ends_with("?\?/"))) return true;
    }
    return false;
}

bool fits_raw_literal(std::string_view text) {
    return text.find('\n') != std::string_view::npos && std::ranges::all_of(text, is_plain) &&
           !has_joining_end(text);
}

std::string raw_literal(std::string_view text) {
    std::string delimiter = "gobo";
    // At most 16 characters are allowed; a text would have to hold thousands of these to get there.
    for (int number = 2; text.find(")" + delimiter + "\"") != std::string_view::npos; ++number)
        delimiter = fmt::format("gobo{}", number);
    return fmt::format("R\"{0}({1}){0}\"", delimiter, text);
}

std::string escaped_literal(std::string_view text) {
    std::string literal = "\"";
    for (const char character : text) {
        if (character == '"' || character == '\\')
            literal += {'\\', character};
        else if (character == '\n')
            literal += "\\n";
        else if (is_plain(character) && character != '\t' && character != '?')
            literal += character;
        else  // three octal digits end by themselves, unlike hexadecimal ones; '?' would start a trigraph
            literal += fmt::format("\\{:03o}", static_cast<unsigned char>(character));
    }
    return literal + '"';
}

}  // namespace

std::string cpp_literal(std::string_view text) {
    return fits_raw_literal(text) ? raw_literal(text) : escaped_literal(text);
}

std::string cpp_comment(std::string_view text) {
    std::string result(text);
    // To a compiler that knows trigraphs, "??/" is a '\\'.
    const auto is_unsafe = [](char character) {
        return !is_plain(character) || character == '\n' || character == '\\' || character == '?';
    };
    std::ranges::replace_if(result, is_unsafe, '_');
    return result;
}

std::string cpp_list(const std::vector<std::string>& items) {
    if (items.empty()) return {};
    std::string text = "{";
    std::size_t column = kLineWidth;
    for (const std::string& item : items) {
        const bool breaks = column + item.size() + 2 > kLineWidth;
        if (breaks) column = 8;
        text += breaks ? "\n        " : " ";
        text += item;
        text += ',';
        column += item.size() + 2;
    }
    return text + "\n    }";
}

std::vector<std::string_view> cut_for_literals(std::string_view text) {
    const std::size_t limit = fits_raw_literal(text) ? kLiteralLimit : kLiteralLimit / kLongestEscape;
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

std::string cpp_identifier(std::string_view name) {
    std::string result;
    for (const char character : name) {
        const char kept = is_identifier_part(character) ? character : '_';
        if (kept == '_' && (result.empty() || result.back() == '_')) continue;
        result += kept;
    }
    if (result.empty()) return "unnamed";
    if (!is_identifier_start(result.front())) result.insert(0, 1, '_');
    if (is_reserved_name(result)) result += '_';
    return result;
}

std::string cpp_function_name(std::string_view name) {
    const std::string identifier = cpp_identifier(name);
    return identifier == "min" || identifier == "max" ? identifier + '_' : identifier;
}

std::string cpp_type_name(std::string_view name) {
    std::string result;
    bool starts_word = true;
    for (const char character : name) {
        const bool parts = !is_identifier_part(character) || character == '_';
        if (!parts)
            result += starts_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(character)))
                                  : character;
        starts_word = parts;
    }
    return cpp_identifier(result);
}

bool is_cpp_identifier(std::string_view name) {
    return is_identifier(name) && cpp_identifier(name) == name;
}

std::string CppScope::claim(const std::string& identifier, std::string_view suffix) {
    std::string result = identifier;
    for (int number = 1; !taken_.insert(result).second; ++number) {
        // `default_` and a second `_` would make a name that C++ reserves.
        const bool doubled = identifier.back() == '_' && suffix.starts_with('_');
        result = identifier;
        result += doubled ? suffix.substr(1) : suffix;
        if (number > 1) result += std::to_string(number);
    }
    return result;
}

}  // namespace gobo
