// The surface's normal as the probe has it (S13).
//
// Model:  n turned to the probe's axes.
// Source: Ramamoorthi and Hanrahan, SIGGRAPH 2001.
// Spaces: eye space to the probe's axes. Range: unit or zero.
// Edges:  zero where the surface has no normal (H-N1).
#include <sides>
#include "harmonics/coefficients.glsl"

/// The unit normal of the side that is seen, in the probe's axes.
vec3 probeNormal() { return harmonics.toProbe * visibleNormal(); }
