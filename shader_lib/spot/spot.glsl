// Spot lights: point lights with a cone (L5).
//
// Model:  a point light (L4) times the share of its cone.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual.
// Space:  eye. Ranges: as point lights and coneFactor(); axis unit.
// Edges:  as point lights and coneFactor().
#include <spot_shadows>
#include "guards/polar.glsl"
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "spot/cone.glsl"
#include "surface/position.glsl"

/// `position` is in eye space, its w is 1 (L6); `axis` is the unit vector along which the light shines. The
/// cone is given by the versines of its half angles, 1 - cos(angle), which hold an angle of 1e-4 as well as
/// one of 90 degrees; `attenuation` holds k_c, k_l, k_q.
struct SpotLight {
    vec4 position;
    vec3 color;
    float exponent;
    vec3 attenuation;
    float innerVersine;
    vec3 axis;
    float outerVersine;
};

BLOCK(6, SpotLights) {
    SpotLight lights[SPOT_LIGHTS];
} spotLights;

/// Adds every spot light to the surface's response.
void addSpotLights() {
    for (int i = 0; i < SPOT_LIGHTS; ++i) {
        SpotLight light = spotLights.lights[i];
        vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
        float fading = attenuation(light.attenuation, ray.w);
        float cone = coneFactor(light.axis, -ray.xyz, light.innerVersine, light.outerVersine, light.exponent);
        float share = cone * fading;
#if SPOT_SHADOWS > 0
        if (i < SPOT_SHADOWS) share *= spotVisibility(i);
#endif
        addLightAmbient(fading);  // L9: outside the cone too
        addLight(ray.xyz, share * light.color);
    }
}
