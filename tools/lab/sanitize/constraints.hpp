// What inputs have to do with one another: a shader's contract beside the range of each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "family/family.hpp"

namespace gobo::sanitize {

struct InputSpace;

/// As it is written in [domain], for elements of arrays with [] for each.
struct Constraint {
    enum class Kind {
        less,               ///< `near < far`: numbers
        unit,               ///< `unit(normal)`
        not_zero,           ///< `not_zero(axis)`
        distinct,           ///< `distinct(position, eye)`: vectors that are not equal
        orthonormal,        ///< `orthonormal(tbn)`: a square matrix
        inverse_transpose,  ///< `inverse_transpose_of(normalMatrix, modelView)`: of its upper left 3 x 3
    };
    Kind kind = Kind::less;
    std::vector<std::string> names;
};

/// Whether the text is meant as one: no name of an input holds such signs.
[[nodiscard]] bool is_constraint(std::string_view text);
/// Nothing where it is none that is known.
[[nodiscard]] std::optional<Constraint> constraint_of(std::string_view text);
/// Those among the names of domains that are known.
[[nodiscard]] std::vector<Constraint> constraints_of(const std::vector<Domain>& domains);

/// Changes the point as little as it takes for its inputs to keep the space's constraints.
void constrain(const InputSpace& space, std::span<double> point);

}  // namespace gobo::sanitize
