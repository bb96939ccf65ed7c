// Lights of either kind, as OpenGL's fixed pipeline had them: where w of the position is 0 a directional light along
// (x, y, z), else a point light at (x, y, z) / w. |w| below 2^-20 counts as 0.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Shading with a Directional Light Source; OpenGL Programming Guide,
//         9th ed., ch. 7.
// Ranges: eye space; components within 1e6, colour 0 to 1e5 (radiance at attenuation 1).

#piece directional_or_point
#include <directional_or_point/ray>
#include <lighting/response>

/// Adds every such light to the surface's response.
void addDirectionalOrPointLights() {
    for (int i = 0; i < DIRECTIONAL_OR_POINT_LIGHTS; ++i) {
        LightRay ray = directionalOrPointRay(i);
        addLightAmbient(ray.attenuation);
        addLight(ray.toLight, ray.weight * directionalOrPointLights.lights[i].color);
    }
}

#piece ray/directional_or_point
#include "directional_or_point/either_ray.glsl"
#include "directional_or_point/lights.glsl"

/// The ray to light number i.
LightRay directionalOrPointRay(int i) {
    return eitherRay(directionalOrPointLights.lights[i].position, directionalOrPointLights.lights[i].attenuation);
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
    float byDistance = isLocal ? attenuation(coefficients, ray.w) : 1.0;
    return LightRay(ray.xyz, byDistance, byDistance);
}

#piece lights
/// `position` is a point in eye space, times its w; or where w is 0 the direction to the light, of any length.
/// `attenuation` holds k_c, k_l, k_q, which a direction does not need.
struct DirectionalOrPointLight {
    vec4 position;
    LIGHT_PRECISION vec3 color;
    vec3 attenuation;
};

BLOCK(11, DirectionalOrPointLights) {
    DirectionalOrPointLight lights[DIRECTIONAL_OR_POINT_LIGHTS];
} directionalOrPointLights;
