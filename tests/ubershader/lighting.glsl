// How an ubershader finds its lights: in one array with switches, or in an array for each kind with counts.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_unlit
#define litSurface unlitSurface

#piece as_itself
#undef litSurface

#piece switched
#include <material>
#include <reflection>
#include "lighting/ambient.glsl"
#include "lighting/as_unlit.glsl"
#include "lighting/unlit.glsl"
#include "lighting/as_itself.glsl"
#include "uber/light.glsl"
#include "uber/switches.glsl"

BLOCK(23, SwitchedLights) {
    AnyLight lights[10];
} switchedLights;

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    if (switches.lighting == 1) return unlitSurface();
    chooseMaterial();
    vec3 radiance = material.emission + ambientRadiance() + reflectionRadiance();
    beginResponse();
    for (int i = 0; i < 10; ++i) {
        if (switchedLights.lights[i].isEnabled) addAnyLight(switchedLights.lights[i]);
    }
    return radiance + responseRadiance();
}

#piece looped
#include <material>
#include <reflection>
#include "lighting/ambient.glsl"
#include "lighting/as_unlit.glsl"
#include "lighting/unlit.glsl"
#include "lighting/as_itself.glsl"
#include "uber/light.glsl"
#include "uber/switches.glsl"

BLOCK(23, LoopedLights) {
    AnyLight directional[8];
    AnyLight point[8];
    AnyLight spot[8];
    AnyLight directional_or_point[8];
} loopedLights;

/// Adds a light whose kind is that of its array, whatever it says itself.
void addLightOfKind(AnyLight light, bool isLocal, bool isSpot, bool isDirectionalOrPoint) {
    light.isLocal = isLocal;
    light.isSpot = isSpot;
    light.isDirectionalOrPoint = isDirectionalOrPoint;
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
    for (int i = 0; i < switches.directional_or_point; ++i) addLightOfKind(loopedLights.directional_or_point[i], false, false, true);
    return radiance + responseRadiance();
}
