// Radiance as it is, for a target of 32-bit floats.

/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return radiance; }
