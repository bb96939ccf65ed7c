// Clear air: everything is seen as it is (F1, F2 and F3 are not asked for).

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) { return radiance; }
