// Arrays of lights for each kind, with counts that are read at run time (L8).
//
// Model:  emission + the ambient light + reflections + the response to the first directional, then point,
//         then spot, then homogeneous lights.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Space:  eye. Ranges: counts from 0 to 8; linear radiance, unclamped, not negative.
// Edges:  as the lights'.
#include <material>
#include <reflection>
#include "lighting/ambient.glsl"
#include "lighting/unlit.glsl" with litSurface as unlitSurface
#include "uber/light.glsl"
#include "uber/switches.glsl"

BLOCK(23, LoopedLights) {
    AnyLight directional[8];
    AnyLight point[8];
    AnyLight spot[8];
    AnyLight homogeneous[8];
} loopedLights;

/// Adds a light whose kind is that of its array, whatever it says itself.
void addLightOfKind(AnyLight light, bool isLocal, bool isSpot, bool isHomogeneous) {
    light.isLocal = isLocal;
    light.isSpot = isSpot;
    light.isHomogeneous = isHomogeneous;
    addAnyLight(light);
}

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    if (switches.lighting == 1) return unlitSurface();
    chooseMaterial();
    vec3 radiance = material.emission + ambientRadiance() + reflectionRadiance();
    beginResponse();
    for (int i = 0; i < switches.directional; ++i) addLightOfKind(loopedLights.directional[i], false, false, false);
    for (int i = 0; i < switches.point; ++i) addLightOfKind(loopedLights.point[i], true, false, false);
    for (int i = 0; i < switches.spot; ++i) addLightOfKind(loopedLights.spot[i], true, true, false);
    for (int i = 0; i < switches.homogeneous; ++i) addLightOfKind(loopedLights.homogeneous[i], false, false, true);
    return radiance + responseRadiance();
}
