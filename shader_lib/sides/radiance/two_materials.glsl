// The radiance of a surface whose vertices are shaded on both sides, with a material each (S11).
#include "sides/radiance/two.glsl"
