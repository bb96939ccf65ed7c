// The cosines of all lights at a vertex, for tones that are found per fragment (S8).
//
// Model:  n.s, n the front's normal.
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, version I.
// Space:  eye. Range: -1 to 1. Edges: 0 where there is no normal or no direction to the light (H-N1, H-L1).
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
    float cosines[4 * intensityVectors];
    vec3 normal = surfaceNormal();
    int next = 0;
#if DIRECTIONAL_LIGHTS > 0
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i) cosines[next++] = dot(normal, directionalRay(i));
#endif
#if POINT_LIGHTS > 0
    for (int i = 0; i < POINT_LIGHTS; ++i) cosines[next++] = dot(normal, pointRay(i).toLight);
#endif
#if SPOT_LIGHTS > 0
    for (int i = 0; i < SPOT_LIGHTS; ++i) cosines[next++] = dot(normal, spotRay(i).toLight);
#endif
#if HOMOGENEOUS_LIGHTS > 0
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i) cosines[next++] = dot(normal, homogeneousRay(i).toLight);
#endif
    while (next < 4 * intensityVectors) cosines[next++] = 0.0;
    vec4 vectors[intensityVectors];
    for (int i = 0; i < intensityVectors; ++i)
        vectors[i] = vec4(cosines[4 * i], cosines[4 * i + 1], cosines[4 * i + 2], cosines[4 * i + 3]);
    return vectors;
}
