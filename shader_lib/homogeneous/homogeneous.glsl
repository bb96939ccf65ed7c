// Lights of either kind, directional or local, told apart by one vector's fourth component (L6).
//
// Model:  w = 0: s along (x, y, z), no attenuation (L3); otherwise a point light at (x, y, z) / w (L4).
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Shading with a Directional Light Source.
// Space:  eye. Ranges: components within 1e6, colour 0 to 1e5 (radiance at attenuation 1).
// Edges:  |w| below 2^-20 counts as 0; a light at the surface's own position and a zero direction give no
//         light (H-L1).
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "surface/position.glsl"

/// `position` is a point in eye space, times its w; or where w is 0 the direction to the light, of any length.
/// `attenuation` holds k_c, k_l, k_q, which a direction does not need.
struct HomogeneousLight {
    vec4 position;
    vec3 color;
    vec3 attenuation;
};

BLOCK(11, HomogeneousLights) {
    HomogeneousLight lights[HOMOGENEOUS_LIGHTS];
} homogeneousLights;

/// Adds every homogeneous light to the surface's response.
void addHomogeneousLights() {
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i) {
        HomogeneousLight light = homogeneousLights.lights[i];
        float w = light.position.w;
        bool isLocal = abs(w) >= 9.5367431640625e-7;
        vec3 place = light.position.xyz;
        vec4 ray = directionAndLength(isLocal ? place / w - surfacePosition() : place);
        float fading = isLocal ? attenuation(light.attenuation, ray.w) : 1.0;
        addLightAmbient(fading);
        addLight(ray.xyz, fading * light.color);
    }
}
