// The radiance of a surface whose vertices are shaded on one side.

/// The radiance interpolated between the vertices.
vec3 interpolatedRadiance() { return litRadiance; }
