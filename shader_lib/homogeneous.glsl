// Lights of either kind, as OpenGL's fixed pipeline had them: where w of the position is 0 a directional light along
// (x, y, z), else a point light at (x, y, z) / w. |w| below 2^-20 counts as 0.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Shading with a Directional Light Source; OpenGL Programming Guide,
//         9th ed., ch. 7.
// Ranges: eye space; components within 1e6, colour 0 to 1e5 (radiance at attenuation 1).

#piece homogeneous
#include <homogeneous/ray>
#include "lighting/response.glsl"

/// Adds every homogeneous light to the surface's response.
void addHomogeneousLights() {
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i) {
        LightRay ray = homogeneousRay(i);
        addLightAmbient(ray.fading);
        addLight(ray.toLight, ray.share * homogeneousLights.lights[i].color);
    }
}

#piece ray/homogeneous
#include "homogeneous/either_ray.glsl"
#include "homogeneous/lights.glsl"

/// The ray to light number i.
LightRay homogeneousRay(int i) {
    return eitherRay(homogeneousLights.lights[i].position, homogeneousLights.lights[i].attenuation);
}

#piece either_ray
// A light at the surface's own position, or in the direction zero, gives nothing.
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "shading/light_ray.glsl"
#include "surface/position.glsl"

/// The ray to a light at a point in eye space, times its w, or in a direction of any length, w being 0.
LightRay eitherRay(vec4 position, vec3 coefficients) {
    float w = position.w;
    bool isLocal = abs(w) >= 9.5367431640625e-7;
    vec4 ray = directionAndLength(isLocal ? position.xyz / w - surfacePosition() : position.xyz);
    float fading = isLocal ? attenuation(coefficients, ray.w) : 1.0;
    return LightRay(ray.xyz, fading, fading);
}

#piece lights
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
