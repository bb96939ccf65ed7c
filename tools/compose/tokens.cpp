#include "compose/tokens.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::array<std::string_view, 9> kLongOperators = {
    "&&", "||", "==", "!=", "<=", ">=", "<<", ">>", "##"};

bool is_digit(char character) {
    return character >= '0' && character <= '9';
}

/// How many characters the token takes that `rest` begins with.
std::size_t length_of_token(std::string_view rest) {
    const bool is_number =
        is_digit(rest.front()) || (rest.size() > 1 && rest.front() == '.' && is_digit(rest[1]));
    if (is_number || is_identifier_start(rest.front())) {
        const auto goes_on = [&](char character) {
            return is_identifier_part(character) || (is_number && character == '.');
        };
        return static_cast<std::size_t>(std::ranges::find_if_not(rest, goes_on) - rest.begin());
    }
    constexpr std::string_view kSecond = "&|=<>#";
    const bool may_be_long = rest.size() > 1 && kSecond.find(rest[1]) != std::string_view::npos;
    return may_be_long && std::ranges::find(kLongOperators, rest.substr(0, 2)) != kLongOperators.end() ? 2
                                                                                                       : 1;
}

}  // namespace

std::vector<std::string_view> tokens_of(std::string_view code) {
    std::vector<std::string_view> tokens;
    for (auto token = next_token(code); !token.empty(); token = next_token(code)) tokens.push_back(token);
    return tokens;
}

std::string_view next_token(std::string_view& code) {
    const auto is_blank = [](char character) {
        return character == ' ' || character == '\t' || character == '\n';
    };
    code = {std::ranges::find_if_not(code, is_blank), code.end()};
    const std::string_view token = code.empty() ? code : code.substr(0, length_of_token(code));
    code.remove_prefix(token.size());
    return token;
}

}  // namespace gobo
