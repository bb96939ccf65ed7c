// The whole lighting model at one point of the surface, in whichever stage it is evaluated: emission + ambient light +
// what is mirrored + the response to exactly the lights that the key counts. Linear, unclamped, not negative.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.

#include <directional>
#include <directional_or_point>
#include <material>
#include <point>
#include <reflection>
#include <spot>
#include "lighting/ambient.glsl"

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    chooseMaterial();
    vec3 radiance = material.emission + ambientRadiance() + reflectionRadiance();
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + DIRECTIONAL_OR_POINT_LIGHTS > 0
    beginResponse();
#endif
#if DIRECTIONAL_LIGHTS > 0
    addDirectionalLights();
#endif
#if POINT_LIGHTS > 0
    addPointLights();
#endif
#if SPOT_LIGHTS > 0
    addSpotLights();
#endif
#if DIRECTIONAL_OR_POINT_LIGHTS > 0
    addDirectionalOrPointLights();
#endif
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + DIRECTIONAL_OR_POINT_LIGHTS > 0
    radiance += responseRadiance();
#endif
    return radiance;
}
