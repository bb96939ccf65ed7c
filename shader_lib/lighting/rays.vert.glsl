// The rays to all local lights at a vertex, for hybrid shading: direction and weight of each, as a varying.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.

#include <point/ray>
#include <spot/ray>

#if POINT_LIGHTS + SPOT_LIGHTS > 0
/// Once raysToLights() has been called: point lights first, the unit vector to the light in xyz, the weight of
/// its light that arrives in w.
vec4 rayToLight[POINT_LIGHTS + SPOT_LIGHTS];

/// A ray as the vertex stage writes it.
vec4 packedRay(LightRay ray) { return vec4(ray.toLight, ray.weight); }

/// Computes the rays to all local lights, once.
vec4[POINT_LIGHTS + SPOT_LIGHTS] raysToLights() {
#if POINT_LIGHTS > 0
    for (int i = 0; i < POINT_LIGHTS; ++i) rayToLight[i] = packedRay(pointRay(i));
#endif
#if SPOT_LIGHTS > 0
    for (int i = 0; i < SPOT_LIGHTS; ++i) rayToLight[POINT_LIGHTS + i] = packedRay(spotRay(i));
#endif
    return rayToLight;
}
#endif
