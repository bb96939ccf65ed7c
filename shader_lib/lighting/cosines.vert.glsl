// n.l of all lights at a vertex, for tones that are found per fragment; n is the front's normal.
//
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, version I.
// Edges:  0 where there is no normal or no direction to the light.

#include <directional/ray>
#include <directional_or_point/ray>
#include <point/ray>
#include <spot/ray>
#include "surface/normal.glsl"

/// So many vectors hold the cosines of all lights, four each.
const int cosineVectors =
    (DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + DIRECTIONAL_OR_POINT_LIGHTS + 3) / 4;

/// The cosine of each light, four to a vector and 0 behind the last: directional lights, point lights, spot lights,
/// lights of either kind.
vec4[cosineVectors] cosinesOfLights() {
    vec4 cosines[cosineVectors];
    for (int i = 0; i < cosineVectors; ++i) cosines[i] = vec4(0.0);
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
#if DIRECTIONAL_OR_POINT_LIGHTS > 0
    for (int i = 0; i < DIRECTIONAL_OR_POINT_LIGHTS; ++i, ++next)
        cosines[next / 4][next % 4] = dot(normal, directionalOrPointRay(i).toLight);
#endif
    return cosines;
}
