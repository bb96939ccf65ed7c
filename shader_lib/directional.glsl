// Directional lights: so far away that their direction is the same everywhere, and they are not attenuated.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Ranges: eye space; colour 0 to 1e5 (radiance).

#piece directional
#include <directional_shadows>
#include <shading/directional_ray>
#include "directional/lights.glsl"
#include <lighting/response>

/// Adds every directional light to the surface's response.
void addDirectionalLights() {
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i) {
        LIGHT_PRECISION vec3 color = directionalLights.lights[i].color;
#if DIRECTIONAL_SHADOWS > 0
        if (i < DIRECTIONAL_SHADOWS) color *= directionalVisibility(i);
#endif
        addLightAmbient(1.0);
        addLight(directionalRay(i), color);
    }
}

#piece lights
/// `direction` is the unit vector from the surface to the light, in eye space.
struct DirectionalLight {
    vec3 direction;
    LIGHT_PRECISION vec3 color;
};

BLOCK(4, DirectionalLights) {
    DirectionalLight lights[DIRECTIONAL_LIGHTS];
} directionalLights;

#piece ray/directional
// directionalRay(), where there are such lights.
#include <shading/directional_ray>
