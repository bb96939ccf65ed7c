// One array of lights of every kind, each switched at run time: what an ubershader does (L8).
//
// Model:  emission + the ambient light + reflections + the response to the lights that are enabled, in the
//         array's order.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Space:  eye. Range: linear radiance, unclamped, not negative.
// Edges:  as the lights'.
#include <material>
#include <reflection>
#include "lighting/ambient.glsl"
#include "lighting/unlit.glsl" with litSurface as unlitSurface
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
