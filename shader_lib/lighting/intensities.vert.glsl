// n.l of all lights at a vertex, for tones that are found per fragment; n is the front's normal.
//
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, version I.
// Edges:  0 where there is no normal or no direction to the light.

#include <directional/ray>
#include <homogeneous/ray>
#include <point/ray>
#include <spot/ray>
#include "surface/normal.glsl"

/// So many vectors hold the cosines of all lights, four each.
const int intensityVectors =
    (DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + HOMOGENEOUS_LIGHTS + 3) / 4;

/// The cosine of each light, four to a vector and 0 behind the last: directional lights, point lights, spot lights,
/// homogeneous lights.
vec4[intensityVectors] intensitiesOfLights() {
    vec4 cosines[intensityVectors];
    for (int i = 0; i < intensityVectors; ++i) cosines[i] = vec4(0.0);
    vec3 normal = surfaceNormal();
    int next = 0;
#if DIRECTIONAL_LIGHTS > 0
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i, ++next)
        cosines[next / 4][next % 4] = dot(normal, directionalRay(i));
#endif
#if POINT_LIGHTS > 0
    for (int i = 0; i < POINT_LIGHTS; ++i, ++next)
        cosines[next / 4][next % 4] = dot(normal, pointRay(i).toLight);
#endif
#if SPOT_LIGHTS > 0
    for (int i = 0; i < SPOT_LIGHTS; ++i, ++next)
        cosines[next / 4][next % 4] = dot(normal, spotRay(i).toLight);
#endif
#if HOMOGENEOUS_LIGHTS > 0
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i, ++next)
        cosines[next / 4][next % 4] = dot(normal, homogeneousRay(i).toLight);
#endif
    return cosines;
}
