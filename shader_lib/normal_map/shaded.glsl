// The normal that the surface is shaded with.

#piece none
// Its own.
#include <surface/normal.glsl>

#piece tangent
// (x, y, z) = 2 texel - 1 along tangent, bitangent and normal, x and y scaled: x s T + y s w (N x T) + z N, made unit. The tangents are
// those of MikkTSpace, interpolated as they are.
// Source: glTF 2.0, 3.7.2.1 and 3.9.3; Mikkelsen, Simulation of Wrinkled Surfaces Revisited (2008).
// Edges:  where the sum is zero, as at a texel of (1/2, 1/2, 1/2), it is the surface's own normal; a surface without tangents sees z
//         alone.
#include <guards/unit_vector>
#include <normal>
#include <texture_placement>
#include "pbr/material.glsl"

/// Linear.
SAMPLER(8, sampler2D) normalMap;

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() {
    vec3 normal = shadingDirection(eyeNormal);
    vec3 bitangent = eyeTangent.w * cross(normal, eyeTangent.xyz);
    vec3 texel = 2.0 * texture(normalMap, mapCoordinate(2)).xyz - 1.0;
    vec3 mapped = material.normalScale * (texel.x * eyeTangent.xyz + texel.y * bitangent) + texel.z * normal;
    return dot(mapped, mapped) < 1e-12 ? normal : unitVector(mapped);  // guard: texel without a direction
}
