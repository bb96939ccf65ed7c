// The environment mirrored by the surface, where a switch has it so (L8, S14).
//
// Model:  that of the mirrored environment, or 0.
// Source, spaces, edges: as the mirrored environment's.
#include "reflection/image.glsl" with reflectionRadiance as mirroredRadiance
#include "uber/switches.glsl"

/// The radiance of what is mirrored.
vec3 reflectionRadiance() { return switches.reflection == 1 ? mirroredRadiance() : vec3(0.0); }
