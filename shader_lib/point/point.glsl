// Point lights: they shine from a position to all sides alike (L4).
//
// Model:  s = (P - p) / d, attenuated by distance.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Space:  eye. Ranges: positions within 1e6, colour 0 to 1e5 (radiance at attenuation 1).
// Edges:  a light at the surface's own position gives no light (H-L1).
#include <point_shadows>
#include "guards/polar.glsl"
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "surface/position.glsl"

/// `position` is in eye space, its w is 1 (L6); `attenuation` holds k_c, k_l, k_q.
struct PointLight {
    vec4 position;
    vec3 color;
    vec3 attenuation;
};

BLOCK(5, PointLights) {
    PointLight lights[POINT_LIGHTS];
} pointLights;

/// Adds every point light to the surface's response.
void addPointLights() {
    for (int i = 0; i < POINT_LIGHTS; ++i) {
        PointLight light = pointLights.lights[i];
        vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
        float fading = attenuation(light.attenuation, ray.w);
        float share = fading;
#if POINT_SHADOWS > 0
        if (i < POINT_SHADOWS) share *= pointVisibility(i);
#endif
        addLightAmbient(fading);
        addLight(ray.xyz, share * light.color);
    }
}
