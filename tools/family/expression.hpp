// Conditions over the features of a family: `shading == hybrid && directional + point + spot > 12`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

struct Feature;

/// A condition over a key. Negations are carried out as it is read.
///
/// Grammar: or  := and ("||" and)*        and := not ("&&" not)*
///          not := "!" not | "(" or ")" | sum op (value | sum)
///          sum := feature ("+" feature)*     (more than one only for counts and defines: off is 0, on 1)
///          op  := "==" | "!=" | "<" | "<=" | ">" | ">="
/// Choices and defines compare with == and != only; counts compare with a whole number or with other counts.
/// What is added and compared are the indices of values: where a count begins above 0, `value` is less by as
/// much.
struct Expression {
    enum class Kind { compare, conjunction, disjunction };
    enum class Comparison { equal, not_equal, less, less_equal, greater, greater_equal };

    Kind kind = Kind::conjunction;
    std::vector<int> features = {};             ///< compare: the features whose values are added
    std::vector<int> subtracted = {};           ///< compare: those whose values are taken off that sum
    Comparison comparison = Comparison::equal;  ///< compare
    int value = 0;                              ///< compare: a number, or the index of a choice's value
    std::vector<Expression> parts = {};         ///< conjunction (of none: true), disjunction (of none: false)
};

/// By Comparison.
inline constexpr std::string_view kComparisonSymbols[] = {"==", "!=", "<", "<=", ">", ">="};

/// The condition that holds where this one does not.
[[nodiscard]] Expression negated(Expression expression);

/// Reads a condition. `place` is that of its first character. An unknown feature or value suggests the
/// nearest; the fault is that of the caller's choosing (usage for --where, input for a family file).
[[nodiscard]] Result<Expression> parse_expression(std::string_view text, const std::vector<Feature>& features,
                                                  const Place& place, Fault fault);

/// `left comparison right`, for whole numbers.
[[nodiscard]] bool compare(int left, Expression::Comparison comparison, int right);

/// Whether the condition holds for a key (value indices in the order of the features it was parsed with).
[[nodiscard]] bool holds(const Expression& expression, const std::vector<int>& key);

}  // namespace gobo
