// When a trap of the sanitizer's table cannot happen.
#pragma once

#include <string_view>
#include <vector>

#include "lab/prove/ranges.hpp"

namespace gobo::prove {

/// What the rules see of a site: its operands, component by component, in the context that it runs in.
struct View {
    Ranges& ranges;
    const evaluate::Program& program;
    const Expressions& expressions;
    const Site& site;

    [[nodiscard]] const evaluate::OperationInfo& info() const { return program.infos[site.operation]; }
    /// Component of an operand; that of a scalar operand is the same for all.
    [[nodiscard]] std::uint32_t operand(std::size_t index, std::uint32_t component) const;
    /// The first of an operand's components, which stand in a row.
    [[nodiscard]] const std::uint32_t* vector(std::size_t index) const;
    [[nodiscard]] const Range& range(std::size_t index, std::uint32_t component) const {
        return ranges.range(operand(index, component));
    }
};

/// A trap of one operation and how it is excluded.
struct Rule {
    std::string_view message;  ///< as the sanitizer's
    /// Whether it never happens, for what is known.
    bool (*is_impossible)(View&);
    std::uint32_t deciding = 0;  ///< bit i: operand i decides; an operation all of whose deciding operands
                                 ///< are constants is trivial
    bool is_of_results = false;  ///< NaN or infinity made from finite numbers
};

/// Of every operation of the program, all its rules, in the order of the sanitizer's table: then index out of
/// bounds, infinity and NaN made from finite numbers. A rule of that table which nothing here excludes has no
/// `is_impossible`.
[[nodiscard]] std::vector<std::vector<Rule>> rules_of(const evaluate::Program& program);

/// Those of the sanitizer's table that nothing here excludes.
[[nodiscard]] std::vector<std::string_view> rules_without_proof();

inline constexpr std::string_view kOutOfBounds = "array index out of bounds";
inline constexpr std::string_view kMakesInfinity = "an infinity made from finite numbers";
inline constexpr std::string_view kMakesNaN = "a NaN made from finite numbers";

}  // namespace gobo::prove
