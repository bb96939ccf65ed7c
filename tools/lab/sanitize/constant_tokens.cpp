#include "lab/sanitize/constant_tokens.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string>

namespace gobo::sanitize {
namespace {

/// How many characters the number takes that `rest` begins with.
std::size_t length_of_number(std::string_view rest) {
    const bool is_hexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
    std::size_t length = 0;
    while (length < rest.size()) {
        const char c = rest[length];
        const bool is_exponent_sign = (c == '+' || c == '-') && length > 0 && !is_hexadecimal &&
                                      (rest[length - 1] == 'e' || rest[length - 1] == 'E');
        if (!is_identifier_part(c) && c != '.' && !is_exponent_sign) break;
        ++length;
    }
    return length;
}

std::size_t length_of_token(std::string_view rest) {
    constexpr std::array<std::string_view, 22> kOperators = {
        "<<=", ">>=", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "^^",
        "++",  "--",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "##"};
    if (std::isdigit(static_cast<unsigned char>(rest.front())) != 0 ||
        (rest.front() == '.' && rest.size() > 1 && std::isdigit(static_cast<unsigned char>(rest[1])) != 0))
        return length_of_number(rest);
    if (is_identifier_start(rest.front())) {
        std::size_t length = 1;
        while (length < rest.size() && is_identifier_part(rest[length])) ++length;
        return length;
    }
    for (const std::string_view longer : kOperators)
        if (rest.starts_with(longer)) return longer.size();
    return 1;
}

}  // namespace

bool is_number(std::string_view text) {
    return std::isdigit(static_cast<unsigned char>(text.front())) != 0 ||
           (text.front() == '.' && text.size() > 1);
}

std::vector<Token> lines_as_tokens(std::string_view source) {
    std::vector<Token> tokens;
    int line = 1;
    while (!source.empty()) {
        const std::string_view text = source.substr(0, source.find('\n'));
        source.remove_prefix(std::min(text.size() + 1, source.size()));
        std::string_view rest = text;
        while (true) {
            while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.front())) != 0)
                rest.remove_prefix(1);
            if (rest.empty() || rest.front() == '#') break;
            tokens.push_back({rest.substr(0, length_of_token(rest)), line});
            rest.remove_prefix(tokens.back().text.size());
        }
        ++line;
    }
    return tokens;
}

Constant literal(std::string_view text) {
    const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    std::string digits(text);
    bool is_unsigned = false;
    bool is_float = !is_hexadecimal && digits.find_first_of(".eE") != std::string::npos;
    if (!is_hexadecimal && (digits.ends_with("lf") || digits.ends_with("LF"))) return std::nullopt;
    if (!is_hexadecimal && (digits.ends_with('f') || digits.ends_with('F'))) {
        digits.pop_back();
        is_float = true;
    } else if (digits.ends_with('u') || digits.ends_with('U')) {
        digits.pop_back();
        is_unsigned = true;
    }
    if (is_float) {
        float number = 0;
        const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (read.ec == std::errc::result_out_of_range) return std::nullopt;
        return ConstantValue{{Scalar::float32, 1, 1}, 0, {static_cast<double>(number)}};
    }
    std::uint64_t number = 0;
    const int base = is_hexadecimal ? 16 : digits.size() > 1 && digits.front() == '0' ? 8 : 10;
    const char* const begin = digits.data() + (is_hexadecimal ? 2 : 0);
    std::from_chars(begin, digits.data() + digits.size(), number, base);
    const auto bits = static_cast<std::uint32_t>(number);
    const double value =
        is_unsigned ? static_cast<double>(bits) : static_cast<double>(static_cast<std::int32_t>(bits));
    return ConstantValue{{is_unsigned ? Scalar::uint32 : Scalar::int32, 1, 1}, 0, {value}};
}

}  // namespace gobo::sanitize
