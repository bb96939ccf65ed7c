// The half angles of a spot light's cone as the family `lit` takes them: by 1 - cos(angle), since a float
// cosine is 1 for all angles below 3.5e-4 radians.
#pragma once

#include <cmath>

namespace gobo {

/// Of a half angle in radians, 0 to pi (0 is no light, pi / 2 the half space, pi all directions); as many
/// digits as the angle has, however small it is.
[[nodiscard]] inline float one_minus_cosine_of_radians(double radians) {
    const double half_sine = std::sin(radians / 2);
    return static_cast<float>(2 * half_sine * half_sine);
}

/// The same in degrees, 0 to 180: a cutoff as the OpenGL Programming Guide gives it.
[[nodiscard]] inline float one_minus_cosine_of_degrees(double degrees) {
    return one_minus_cosine_of_radians(degrees * 0.017453292519943295);
}

/// Of a half angle given by its cosine, -1 to 1. Near 1 the cosine's own rounding is in the result.
[[nodiscard]] inline float one_minus_cosine(double cosine) {
    return static_cast<float>(1 - cosine);
}

}  // namespace gobo
