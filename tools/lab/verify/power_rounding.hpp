// How far a highlight's lobe, evaluated in floats, may be from the exact value of the same formula.
#pragma once

#include "lab/oracle/model.hpp"

namespace gobo::verify {

/// A versine, known to within `error`.
struct Versine {
    double value = 0;
    double error = 0;
};

/// Bound of the error of `oracle::lobe()` for a versine that is off by its error: the spread of the lobe over
/// that error, evaluated at both ends since the slope may be infinite, and the formula's own roundings.
[[nodiscard]] double power_error(oracle::Power power, const Versine& versine, double exponent);

}  // namespace gobo::verify
