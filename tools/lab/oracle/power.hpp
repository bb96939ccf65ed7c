// The lobe of a highlight: the power of a cosine, exactly and by what stands in for it.
#pragma once

#include "lab/oracle/model.hpp"

namespace gobo::oracle {

/// The highlight's share at 1 - cos(angle) = versine, from 0 to 2:
/// - exact: max(cos, 0)^m, with 0^0 = 1;
/// - near_exact: exp(2 m (z + z^3 / 3)) with z = (cos - 1) / (cos + 1), the beginning of the series of
/// log(cos)
///   (Abramowitz and Stegun 4.1.27); 0 from a right angle on, where m > 0;
/// - squaring: max(cos, 0)^n, n the whole number nearest to m, an even one where two are as near;
/// - gaussian, gaussian_fitted: exp(s (cos - 1)) with s = m, or s = m + 0.664 (Wang et al., 2009);
/// - lyon: max(1 - m (1 - cos) / 4, 0)^4 (Lyon, 1993);
/// - schlick: cos / (m - m cos + cos) (Schlick, Graphics Gems IV); 0 from a right angle on, where m > 0.
[[nodiscard]] double lobe(Power power, double versine, double shininess);

}  // namespace gobo::oracle
