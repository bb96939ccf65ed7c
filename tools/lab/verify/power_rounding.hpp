// How far a highlight's lobe, evaluated in floats, may be from the exact value of the same formula.
#pragma once

#include "lab/oracle/model.hpp"

namespace gobo::verify {

/// A one minus cosine, known to within `error`.
struct OneMinusCosine {
    double value = 0;
    double error = 0;
};

/// Bound of the error of `oracle::lobe()` for a one minus cosine that is off by its error: the spread of the
/// lobe over that error, evaluated at both ends since the slope may be infinite, and the formula's own
/// roundings.
[[nodiscard]] double power_error(oracle::Power power, const OneMinusCosine& one_minus_cosine,
                                 double exponent);

}  // namespace gobo::verify
