// The fog that a switch chooses at run time: each in a function of its own (L8).
//
// Model:  that of the chosen fog.
// Source: as the fogs'.
// Range:  as the fogs'.
// Edges:  as the fogs'; an unknown number is clear air.
#include "fog/exponential.glsl" with throughFog as throughExponentialFog
#include "fog/exponential_squared.glsl" with throughFog as throughExponentialSquaredFog
#include "fog/linear.glsl" with throughFog as throughLinearFog
#include "uber/switches.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    if (switches.fog == 1) return throughLinearFog(radiance);
    if (switches.fog == 2) return throughExponentialFog(radiance);
    if (switches.fog == 3) return throughExponentialSquaredFog(radiance);
    return radiance;
}
