// The radiance, which is not negative, as the render target can hold it.

#piece unbounded
// 32-bit floats: as it is, an infinite radiance too.
/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return radiance; }

#piece half_float
// 16-bit floats: what they cannot hold is the brightest that they can, not infinity. Source: IEEE 754-2019, 3.6: the
// largest finite binary16 is (2 - 2^-10) 2^15; from 65520 on a conversion rounds to infinity.
/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return min(radiance, vec3(65504.0)); }  // guard: brighter than the target holds

#piece display
// A display of fixed range. Source: OpenGL Programming Guide, 9th ed., ch. 7: the texts' min(rgb, vec3(1.0)).
/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return min(radiance, vec3(1.0)); }  // guard: brighter than the target holds
