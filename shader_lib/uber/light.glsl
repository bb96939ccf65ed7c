// A light of any kind, whose kind is known at run time (L8).
//
// Model:  that of directional (L3), point (L4) and spot lights (L5).
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Space:  eye. Ranges: as those of directional, point and spot lights.
// Edges:  as theirs.
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "lighting/response.glsl"
#include "spot/cone.glsl"
#include "surface/position.glsl"

/// `position` is a position where the light is local, else the unit vector to it. What a kind has no use for
/// is not read.
struct AnyLight {
    vec4 position;
    vec3 color;
    float exponent;
    vec3 attenuation;
    float innerVersine;
    vec3 axis;
    float outerVersine;
    bool isEnabled;
    bool isLocal;
    bool isSpot;
};

/// Adds a light to the surface's response.
void addAnyLight(AnyLight light, bool isLocal, bool isSpot) {
    vec3 toLight = light.position.xyz;
    float fading = 1.0;
    float share = 1.0;
    if (isLocal) {
        vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
        toLight = ray.xyz;
        fading = attenuation(light.attenuation, ray.w);
        if (isSpot)
            share = coneFactor(light.axis, -toLight, light.innerVersine, light.outerVersine, light.exponent);
        share *= fading;
    }
    addLightAmbient(fading);
    addLight(toLight, share * light.color);
}
