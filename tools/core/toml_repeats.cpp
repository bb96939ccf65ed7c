#include "core/toml_repeats.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// The key that ends there, with its dots and quotes: `"a b".c` of `x = { "a b".c`.
std::string_view last_key(std::string_view before) {
    const std::string_view text = trim(before);
    std::size_t begin = text.size();
    while (begin > 0) {
        const char last = text[begin - 1];
        if (last == '"' || last == '\'') {
            const std::size_t open = begin > 1 ? text.rfind(last, begin - 2) : std::string_view::npos;
            if (open == std::string_view::npos) break;
            begin = open;
        } else if (is_identifier_part(last) || last == '-' || last == '.') {
            --begin;
        } else {
            break;
        }
    }
    return text.substr(begin);
}

}  // namespace

std::optional<std::string> repeated_key(std::string_view description, std::string_view text, std::size_t line,
                                        std::size_t column) {
    if (description.find("cannot redefine existing") == std::string_view::npos) return std::nullopt;
    for (std::size_t number = 1; number < line; ++number)
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find('\n'));
    if (const std::string_view header = trim(text); header.starts_with('[')) {
        const std::size_t begin = header.find_first_not_of('[');
        const std::size_t end = std::min(header.rfind(']'), header.size());
        const std::string_view name = trim(header.substr(std::min(begin, end), end - std::min(begin, end)));
        return fmt::format("'{}' is there already", name.substr(0, name.find_last_not_of(']') + 1));
    }
    std::string_view before = text.substr(0, std::min(text.rfind('=', column - 1), text.size()));
    return fmt::format("the key '{}' stands twice", last_key(before));
}

}  // namespace gobo
