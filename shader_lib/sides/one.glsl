// One side: the surface is shaded as its normal has it, from wherever it is seen.
#include "surface/normal.glsl"

/// The unit normal that light is weighed against; zero where there is none.
vec3 visibleNormal() { return surfaceNormal(); }
