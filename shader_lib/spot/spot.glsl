// Spot lights: point lights with a cone (L5).
//
// Model:  a point light (L4) times the share of its cone.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual.
// Space:  eye. Ranges: as the lights'.
// Edges:  as point lights and coneFactor().
#include <shading/spot_ray>
#include <spot_shadows>
#include "lighting/response.glsl"
#include "spot/lights.glsl"

/// Adds every spot light to the surface's response.
void addSpotLights() {
    for (int i = 0; i < SPOT_LIGHTS; ++i) {
        LightRay ray = spotRay(i);
        float share = ray.share;
#if SPOT_SHADOWS > 0
        if (i < SPOT_SHADOWS) share *= spotVisibility(i);
#endif
        addLightAmbient(ray.fading);  // L9: outside the cone too
        addLight(ray.toLight, share * spotLights.lights[i].color);
    }
}
