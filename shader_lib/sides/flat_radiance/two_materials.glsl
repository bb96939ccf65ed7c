// The radiance of a face of which one vertex is shaded on both sides, with a material each (S11).
#include "sides/flat_radiance/two.glsl"
