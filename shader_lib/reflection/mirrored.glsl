// The environment in the mirrored direction r = 2 (n.v) n - v, blurred by roughness.

#piece none
/// The radiance of what a surface of that normal and roughness mirrors: none.
vec3 mirroredRadiance(vec3 normal, float roughness) { return vec3(0.0); }

#piece image
// Level by level of a cube map. Source: Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course notes.
// Edges:  without a normal, or at the viewer itself, nothing is mirrored.
#include "pbr/surface.glsl"

/// How much of the map is seen, the rotation from eye space to its axes, and the level of roughness 1.
BLOCK(18, Reflection) {
    mat3 toMap;
    float weight;
    float roughestLevel;
} reflection;

/// S: what a surface shows by the mirrored direction to the viewer, its roughness rising evenly from level to level.
SAMPLER(4, samplerCube) specularMap;

/// The mirrored direction in the map's axes, zero where there is none.
vec3 mirroredDirection(vec3 normal) {
    if (normal == vec3(0.0)) return vec3(0.0);  // guard: zero vector
    return reflection.toMap * reflect(-surface.toViewer, normal);
}

/// The radiance of what a surface of that normal and roughness mirrors, weighted.
vec3 mirroredRadiance(vec3 normal, float roughness) {
    vec3 direction = mirroredDirection(normal);
    if (direction == vec3(0.0)) return vec3(0.0);  // guard: zero vector
    return reflection.weight * textureLod(specularMap, direction, roughness * reflection.roughestLevel).rgb;
}
