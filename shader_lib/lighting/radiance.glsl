// The whole lighting model at one point of the surface, in whichever stage it is evaluated (L7).
//
// Model:  emission + ambient light + what is mirrored + the response to exactly the lights that the key counts.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Space:  eye. Range: linear radiance, unclamped, not negative.
// Edges:  without lights emission, ambient light and what is mirrored remain.
#include <directional>
#include <homogeneous>
#include <material>
#include <point>
#include <reflection>
#include <spot>
#include "lighting/ambient.glsl"

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    chooseMaterial();
    vec3 radiance = material.emission + ambientRadiance() + reflectionRadiance();
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + HOMOGENEOUS_LIGHTS > 0
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
#if HOMOGENEOUS_LIGHTS > 0
    addHomogeneousLights();
#endif
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + HOMOGENEOUS_LIGHTS > 0
    radiance += responseRadiance();
#endif
    return radiance;
}
