// The half vectors of all lights, h = (l + v) / |l + v|, at a vertex, for hybrid shading.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Edges:  zero where the light stands exactly behind the viewer's ray.

#include <directional/ray>
#include <guards/unit_vector>
#include <viewer>
#include "lighting/rays.glsl"

/// The unit vector halfway between each light's direction and the viewer's: directional lights, point lights,
/// spot lights. To be called after raysToLights().
vec3[DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS] halfwaysToLights() {
    vec3 halves[DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS];
    vec3 toViewer = towardViewer();
#if DIRECTIONAL_LIGHTS > 0
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i) halves[i] = unitVector(directionalRay(i) + toViewer);
#endif
#if POINT_LIGHTS + SPOT_LIGHTS > 0
    for (int i = 0; i < POINT_LIGHTS + SPOT_LIGHTS; ++i)
        halves[DIRECTIONAL_LIGHTS + i] = unitVector(rayToLight[i].xyz + toViewer);
#endif
    return halves;
}
