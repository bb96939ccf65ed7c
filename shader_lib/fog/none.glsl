// Clear air: everything is seen as it is.

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) { return radiance; }
