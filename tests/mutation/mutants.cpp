#include "mutants.hpp"

#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// A part of a line and what it becomes.
struct Change {
    std::size_t column = 0;
    std::string from;
    std::string to;
};

/// Longer operators first. "++" stays: it would only make loops endless.
constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kReplacements = {{{"++", "++"},
                                                                                          {"+=", "-="},
                                                                                          {"*=", "/="},
                                                                                          {"==", "!="},
                                                                                          {"!=", "=="},
                                                                                          {"<=", ">"},
                                                                                          {">=", "<"},
                                                                                          {"<", ">="},
                                                                                          {">", "<="},
                                                                                          {"+", "-"},
                                                                                          {"-", "+"},
                                                                                          {"*", "/"},
                                                                                          {"/", "*"},
                                                                                          {"min(", "max("},
                                                                                          {"max(", "min("}}};

bool is_word(char character) {
    return is_identifier_part(character);
}

std::optional<Change> operator_at(std::string_view line, std::size_t column) {
    for (const auto& [from, to] : kReplacements) {
        if (!line.substr(column).starts_with(from)) continue;
        const bool is_name = is_word(from.front());
        if (is_name && column > 0 && is_word(line[column - 1])) continue;
        return Change{column, std::string(from), std::string(to)};
    }
    return std::nullopt;
}

/// The number that starts here, made half as large again.
std::optional<Change> number_at(std::string_view line, std::size_t column) {
    if (std::isdigit(static_cast<unsigned char>(line[column])) == 0) return std::nullopt;
    if (column > 0 && (is_word(line[column - 1]) || line[column - 1] == '.')) return std::nullopt;
    std::size_t end = column;
    while (end < line.size() && (is_word(line[end]) || line[end] == '.' ||
                                 ((line[end] == '-' || line[end] == '+') && line[end - 1] == 'e')))
        ++end;
    const std::string from(line.substr(column, end - column));
    const double value = std::stod(from);
    const bool is_whole = from.find_first_of(".e") == std::string::npos;
    if (is_whole) return Change{column, from, std::to_string(static_cast<int>(value) + 1)};
    std::string to = fmt::format("{}", value == 0 ? 1 : 1.5 * value);
    if (to.find_first_of(".e") == std::string::npos) to += ".0";
    return Change{column, from, to};
}

/// Where a line's code ends, and its comment begins.
std::string_view code_of(std::string_view line) {
    line = line.substr(0, line.find("//"));
    const std::string_view trimmed = trim(line);
    for (const std::string_view declaration : {"#", "BLOCK", "ATTRIBUTE", "OUTPUT", "SAMPLER", "DEPTH"})
        if (trimmed.starts_with(declaration)) return {};
    return line;
}

std::vector<Change> changes_of(std::string_view code) {
    std::vector<Change> changes;
    for (std::size_t column = 0; column < code.size();) {
        std::optional<Change> change = operator_at(code, column);
        if (!change) change = number_at(code, column);
        if (!change) {
            ++column;
            continue;
        }
        column += change->from.size();
        if (change->from != change->to) changes.push_back(std::move(*change));
    }
    return changes;
}

}  // namespace

std::vector<Mutant> mutants_of(const std::string& piece, std::string_view text) {
    std::vector<Mutant> mutants;
    int number = 1;
    for (std::size_t start = 0; start < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        const std::string_view code = code_of(text.substr(start, end - start));
        for (const Change& change : changes_of(code)) {
            Mutant mutant{
                piece, number, fmt::format("{} to {}", change.from, change.to), std::string(text), {}};
            mutant.text.replace(start + change.column, change.from.size(), change.to);
            std::string line(code);
            mutant.mutated_line = trim(line.replace(change.column, change.from.size(), change.to));
            mutants.push_back(std::move(mutant));
        }
        start = end + 1;
    }
    return mutants;
}

}  // namespace gobo
