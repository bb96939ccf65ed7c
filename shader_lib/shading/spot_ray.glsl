// How a spot light reaches the surface, computed where the model is evaluated (L5).
//
// Model:  a point light (L4) times the share of its cone.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual.
// Space:  eye. Ranges: as directionAndLength(), attenuation() and coneFactor().
// Edges:  a light at the surface's own position comes from direction zero (H-L1).
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "shading/light_ray.glsl"
#include "spot/cone.glsl"
#include "spot/lights.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    SpotLight light = spotLights.lights[i];
    vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
    float cone = coneFactor(light.axis, -ray.xyz, light.innerVersine, light.outerVersine, light.exponent);
    float fading = attenuation(light.attenuation, ray.w);
    return LightRay(ray.xyz, fading, cone * fading);
}
