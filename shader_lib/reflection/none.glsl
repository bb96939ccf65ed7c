// The surface mirrors nothing but its lights (S14 is not asked for).

/// The radiance of what is mirrored: none.
vec3 reflectionRadiance() { return vec3(0.0); }
