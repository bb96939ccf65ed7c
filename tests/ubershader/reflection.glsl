// The environment mirrored by the surface, where a switch has it so.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_image
#define reflectionRadiance mirroredRadiance

#piece as_itself
#undef reflectionRadiance

#piece switched
#include "reflection/as_image.glsl"
#include "reflection/image.glsl"
#include "reflection/as_itself.glsl"
#include "uber/switches.glsl"

/// The radiance of what is mirrored.
vec3 reflectionRadiance() { return switches.reflection == 1 ? mirroredRadiance() : vec3(0.0); }
