// What inputs have to do with one another, as [domain] and comments state it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "family/family.hpp"

namespace gobo {

/// As it is written in [domain], for elements of arrays with [] for each.
struct Constraint {
    enum class Kind {
        less,               ///< `near < far`, `0.5 < a`: numbers, or vectors component by component
        less_equal,         ///< `near <= far`
        differ,             ///< `a != 0`
        unit,               ///< `unit(normal)`
        not_zero,           ///< `not_zero(axis)`
        distinct,           ///< `distinct(position, eye)`: vectors that are not equal
        orthonormal,        ///< `orthonormal(tbn)`: a square matrix
        inverse_transpose,  ///< `inverse_transpose_of(normalMatrix, modelView)`: of its upper left 3 x 3
    };
    Kind kind = Kind::less;
    std::vector<std::string> names;  ///< empty: of a comparison the side that is `number`
    double number = 0;
    std::string text;  ///< as written
    Place place;

    [[nodiscard]] bool is_comparison() const { return kind <= Kind::differ; }
    /// Whether a side is a number: it narrows the range of the other.
    [[nodiscard]] bool has_number() const {
        return is_comparison() && (names[0].empty() || names[1].empty());
    }
    /// Where a side is a number: whether the other is at most that, not at least.
    [[nodiscard]] bool is_upper() const { return !names[0].empty(); }
    /// Where a side is a number: the last float that the other may be.
    [[nodiscard]] double bound() const;
};

/// What can be written, for messages.
inline constexpr std::string_view kConstraintHelp =
    "write a comparison of two inputs, or of one and a number, with <, <=, >, >= or != (near < far, "
    "a >= 0.5), or unit(), not_zero(), distinct(,), orthonormal(), inverse_transpose_of(,)";

/// A component of a vector by its name in GLSL: "place.x" or "Fog.color.r".
struct ComponentName {
    std::string of;
    std::size_t component = 0;  ///< from 0
};
/// Nothing where the name ends otherwise.
[[nodiscard]] std::optional<ComponentName> component_name(std::string_view name);
/// The range that [domain] states of a component of the vector of that name, if any.
[[nodiscard]] const Domain* domain_of_component(const std::vector<Domain>& domains, std::string_view name,
                                                std::size_t component);

/// The range of that name, and nothing else about it.
[[nodiscard]] inline Domain plain_domain(const std::string& name, double low, double high) {
    return {name, low, high, false, {}, {}, {}};
}

/// What the name is a member of: "Fog" of "Fog.start"; empty where it is none.
[[nodiscard]] std::string_view struct_of(std::string_view name);

/// Whether the text is meant as one: no name of an input holds such signs.
[[nodiscard]] bool is_constraint(std::string_view text);
/// Nothing where it is none that is known.
[[nodiscard]] std::optional<Constraint> constraint_of(std::string_view text);
/// Those among the names of domains that are known.
[[nodiscard]] std::vector<Constraint> constraints_of(const std::vector<Domain>& domains);

/// The numbers that an input or a component may hold.
struct NumberRange {
    double low = 0;
    double high = 0;
    bool is_float = true;
};
/// One of the constraints that nothing keeps, given the ranges of names and the constraints before it; null
/// where there is none. Of names without a range nothing is known. By `step(number, is_float)` a strictly
/// larger number is larger at least.
[[nodiscard]] const Constraint* contradiction_in(const std::vector<Constraint>& constraints,
                                                 std::map<std::string, NumberRange> ranges,
                                                 double (*step)(double, bool));
/// An error where the domains and constraints leave no inputs. Of several domains of a name the first counts.
[[nodiscard]] Result<void> refuse_contradictions(const std::vector<Domain>& domains);
/// What is said of a constraint that nothing keeps.
[[nodiscard]] Diagnostic contradiction_error(const Constraint& constraint);

}  // namespace gobo
