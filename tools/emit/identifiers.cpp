#include "emit/identifiers.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/text.hpp"

namespace gobo {
namespace {

/// Keywords of C++17 and C++20 and their alternative tokens, then macros that compilers and their standard
/// headers define without being asked (`linux` and `unix` in GNU mode). Sorted.
constexpr std::array reserved = std::to_array<std::string_view>({
    "EOF",
    "INFINITY",
    "NAN",
    "NULL",
    "alignas",
    "alignof",
    "and",
    "and_eq",
    "asm",
    "assert",
    "auto",
    "bitand",
    "bitor",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "char16_t",
    "char32_t",
    "char8_t",
    "class",
    "co_await",
    "co_return",
    "co_yield",
    "compl",
    "concept",
    "const",
    "const_cast",
    "consteval",
    "constexpr",
    "constinit",
    "continue",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "dynamic_cast",
    "else",
    "enum",
    "errno",
    "explicit",
    "export",
    "extern",
    "false",
    "float",
    "for",
    "friend",
    "goto",
    "i386",
    "if",
    "inline",
    "int",
    "linux",
    "long",
    "major",
    "minor",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "not_eq",
    "nullptr",
    "offsetof",
    "operator",
    "or",
    "or_eq",
    "private",
    "protected",
    "public",
    "register",
    "reinterpret_cast",
    "requires",
    "return",
    "short",
    "signed",
    "sizeof",
    "static",
    "static_assert",
    "static_cast",
    "stderr",
    "stdin",
    "stdout",
    "struct",
    "switch",
    "template",
    "this",
    "thread_local",
    "throw",
    "true",
    "try",
    "typedef",
    "typeid",
    "typename",
    "union",
    "unix",
    "unsigned",
    "using",
    "virtual",
    "void",
    "volatile",
    "wchar_t",
    "while",
    "xor",
    "xor_eq",
});
static_assert(std::is_sorted(reserved.begin(), reserved.end()));

bool is_reserved(std::string_view name) {
    return std::binary_search(reserved.begin(), reserved.end(), name);
}

}  // namespace

std::string cpp_identifier(std::string_view name) {
    std::string result;
    for (const char character : name) {
        const char kept = is_identifier_part(character) ? character : '_';
        if (kept == '_' && (result.empty() || result.back() == '_')) continue;
        result += kept;
    }
    if (result.empty()) return "unnamed";
    if (!is_identifier_start(result.front())) result.insert(0, 1, '_');
    if (is_reserved(result)) result += '_';
    return result;
}

std::string cpp_type_name(std::string_view name) {
    std::string result;
    bool starts_word = true;
    for (const char character : name) {
        if (!is_identifier_part(character) || character == '_') {
            starts_word = true;
            continue;
        }
        const auto letter = static_cast<unsigned char>(character);
        result += starts_word ? static_cast<char>(std::toupper(letter)) : character;
        starts_word = false;
    }
    return cpp_identifier(result);
}

bool is_cpp_identifier(std::string_view name) {
    return is_identifier(name) && cpp_identifier(name) == name;
}

std::string CppScope::claim(const std::string& identifier, std::string_view suffix) {
    std::string result = identifier;
    for (int number = 1; !taken_.insert(result).second; ++number) {
        result = identifier;
        // `default_` and a second `_` would make a name that C++ reserves.
        const bool doubled = result.back() == '_' && suffix.starts_with('_');
        result += doubled ? suffix.substr(1) : suffix;
        if (number > 1) result += std::to_string(number);
    }
    return result;
}

}  // namespace gobo
