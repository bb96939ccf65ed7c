// The fog that a switch chooses at run time; an unknown number is clear air.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_exponential
#define throughFog throughExponentialFog

#piece as_exponential_squared
#undef throughFog
#define throughFog throughExponentialSquaredFog

#piece as_linear
#undef throughFog
#define throughFog throughLinearFog

#piece as_itself
#undef throughFog

#piece switched
#include "fog/as_exponential.glsl"
#include "fog/exponential.glsl"
#include "fog/as_exponential_squared.glsl"
#include "fog/exponential_squared.glsl"
#include "fog/as_linear.glsl"
#include "fog/linear.glsl"
#include "fog/as_itself.glsl"
#include "uber/switches.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    if (switches.fog == 1) return throughLinearFog(radiance);
    if (switches.fog == 2) return throughExponentialFog(radiance);
    if (switches.fog == 3) return throughExponentialSquaredFog(radiance);
    return radiance;
}
