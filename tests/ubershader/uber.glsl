// What the switched pieces share.

#piece switches
/// Of each feature the number of a value, from 0, as `lit` lists them; of a kind of light, how many there are.
BLOCK(22, Switches) {
    int ambient;
    int cutout;
    int diffuse;
    int directional;
    int fog;
    int directional_or_point;
    int light_ambient;
    int lighting;
    int material;
    int point;
    int reflection;
    int sides;
    int specular;
    int spot;
    int vertex_color;
} switches;

#piece toon
/// One block for all cartoon shading, since a stage may have 12: the number of bands; cosines, and the tone above each.
BLOCK(7, Toon) {
    int levels;
    vec3 thresholds;
    vec3 tones;
} toon;

#piece light_ambient
/// A_l of the light that is about to be added.
vec3 ambientOfLight;

#piece light
#include <guards/polar>
#include "directional_or_point/either_ray.glsl"
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "shading/light_ray.glsl"
#include "shadow/one_map.glsl"
#include "shadow/six_maps.glsl"
#include "spot/cone.glsl"
#include "surface/position.glsl"
#include "uber/light_ambient.glsl"

/// `position` is where a light is that is local, `direction` is the unit vector to one that is not; of a directional_or_point
/// light the position's w tells which it is. What a kind has no use for is not read.
struct AnyLight {
    vec4 position;
    vec3 color;
    float exponent;
    vec3 attenuation;
    float innerOneMinusCosine;
    vec3 axis;
    float outerOneMinusCosine;
    vec3 direction;
    bool isEnabled;
    vec3 ambient;
    bool isLocal;
    bool isSpot;
    bool isDirectionalOrPoint;
    bool isShadowed;
    Shadow shadow;
};

/// The ray to a directional, point or spot light.
LightRay anyRay(AnyLight light) {
    if (!light.isLocal) return LightRay(light.direction, 1.0, 1.0);
    vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
    float byDistance = attenuation(light.attenuation, ray.w);
    if (!light.isSpot) return LightRay(ray.xyz, byDistance, byDistance);
    float cone = coneFactor(light.axis, -ray.xyz, light.innerOneMinusCosine, light.outerOneMinusCosine, light.exponent);
    return LightRay(ray.xyz, byDistance, cone * byDistance);
}

/// How much of a directional, point or spot light no surface keeps from this one.
float anyVisibility(AnyLight light) {
    if (!light.isShadowed) return 1.0;
    return light.isLocal && !light.isSpot ? cubeVisibility(light.shadow) : mapVisibility(light.shadow);
}

/// Adds a light to the surface's response.
void addAnyLight(AnyLight light) {
    ambientOfLight = light.ambient;
    if (light.isDirectionalOrPoint) {
        LightRay ray = eitherRay(light.position, light.attenuation);
        addLightAmbient(ray.attenuation);
        addLight(ray.toLight, ray.weight * light.color);
    } else {
        LightRay ray = anyRay(light);
        addLightAmbient(ray.attenuation);
        addLight(ray.toLight, ray.weight * anyVisibility(light) * light.color);
    }
}
