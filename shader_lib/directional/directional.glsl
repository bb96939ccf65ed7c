// Directional lights: so far away that they shine from the same side everywhere (L3).
//
// Model:  s constant, no attenuation.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Space:  eye. Ranges: as the lights'.
// Edges:  a zero direction gives no light.
#include <directional_shadows>
#include <shading/directional_ray>
#include "directional/lights.glsl"
#include "lighting/response.glsl"

/// Adds every directional light to the surface's response.
void addDirectionalLights() {
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i) {
        vec3 color = directionalLights.lights[i].color;
#if DIRECTIONAL_SHADOWS > 0
        if (i < DIRECTIONAL_SHADOWS) color *= directionalVisibility(i);
#endif
        addLightAmbient(1.0);
        addLight(directionalRay(i), color);
    }
}
