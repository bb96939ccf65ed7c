// Directional lights: so far away that they shine from the same side everywhere (L3).
//
// Model:  s constant, no attenuation.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Space:  eye. Ranges: direction unit or zero, colour 0 to 1e5 (radiance).
// Edges:  a zero direction gives no light.
#include <directional_shadows>
#include "lighting/response.glsl"

/// `direction` is the unit vector from the surface to the light, in eye space.
struct DirectionalLight {
    vec3 direction;
    vec3 color;
};

BLOCK(4, DirectionalLights) {
    DirectionalLight lights[DIRECTIONAL_LIGHTS];
} directionalLights;

/// Adds every directional light to the surface's response.
void addDirectionalLights() {
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i) {
        vec3 color = directionalLights.lights[i].color;
#if DIRECTIONAL_SHADOWS > 0
        if (i < DIRECTIONAL_SHADOWS) color *= directionalVisibility(i);
#endif
        addLightAmbient(1.0);
        addLight(directionalLights.lights[i].direction, color);
    }
}
