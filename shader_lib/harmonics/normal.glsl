// The surface's normal as the probe has it (S13).
//
// Spaces: eye space to the probe's axes. Range: unit or zero.
#include <sides>
#include "harmonics/coefficients.glsl"

/// The unit normal of the side that is seen, in the probe's axes.
vec3 probeNormal() { return harmonics.toProbe * visibleNormal(); }
