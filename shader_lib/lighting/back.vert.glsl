// The whole lighting model at a vertex of the surface's back, the normal flipped.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading.

#include "lighting/radiance.glsl"
#include "surface/side.glsl"

/// The radiance that leaves the back towards the viewer, before fog.
vec3 litBack() {
    backIsAsked = true;
    vec3 radiance = litSurface();
    backIsAsked = false;
    return radiance;
}
