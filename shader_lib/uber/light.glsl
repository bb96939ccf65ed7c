// A light of any kind, whose kind is known at run time (L8).
//
// Model:  that of directional (L3), point (L4), spot (L5) and homogeneous lights (L6), with shadows (S15) and
//         an ambient colour (L9).
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Space:  eye. Ranges: as those of directional, point, spot and homogeneous lights.
// Edges:  as theirs.
#include <guards/polar>
#include "homogeneous/either_ray.glsl"
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "shading/light_ray.glsl"
#include "shadow/one_map.glsl"
#include "shadow/six_maps.glsl"
#include "spot/cone.glsl"
#include "surface/position.glsl"
#include "uber/light_ambient.glsl"

/// `position` is where a light is that is local, `direction` is the unit vector to one that is not; of a homogeneous
/// light the position's w tells which it is. What a kind has no use for is not read.
struct AnyLight {
    vec4 position;
    vec3 color;
    float exponent;
    vec3 attenuation;
    float innerVersine;
    vec3 axis;
    float outerVersine;
    vec3 direction;
    bool isEnabled;
    vec3 ambient;
    bool isLocal;
    bool isSpot;
    bool isHomogeneous;
    bool isShadowed;
    Shadow shadow;
};

/// The ray to a directional, point or spot light.
LightRay anyRay(AnyLight light) {
    if (!light.isLocal) return LightRay(light.direction, 1.0, 1.0);
    vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
    float fading = attenuation(light.attenuation, ray.w);
    if (!light.isSpot) return LightRay(ray.xyz, fading, fading);
    float cone = coneFactor(light.axis, -ray.xyz, light.innerVersine, light.outerVersine, light.exponent);
    return LightRay(ray.xyz, fading, cone * fading);
}

/// The share of a directional, point or spot light that no surface keeps from this one.
float anyVisibility(AnyLight light) {
    if (!light.isShadowed) return 1.0;
    return light.isLocal && !light.isSpot ? cubeVisibility(light.shadow) : mapVisibility(light.shadow);
}

/// Adds a light to the surface's response.
void addAnyLight(AnyLight light) {
    ambientOfLight = light.ambient;
    if (light.isHomogeneous) {
        LightRay ray = eitherRay(light.position, light.attenuation);
        addLightAmbient(ray.fading);
        addLight(ray.toLight, ray.share * light.color);
    } else {
        LightRay ray = anyRay(light);
        addLightAmbient(ray.fading);
        addLight(ray.toLight, ray.share * anyVisibility(light) * light.color);
    }
}
