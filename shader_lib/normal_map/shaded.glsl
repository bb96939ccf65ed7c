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
#include "normal_map/texel.glsl"

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() {
    vec3 normal = shadingDirection(eyeNormal);
    vec3 bitangent = eyeTangent.w * cross(normal, eyeTangent.xyz);
    vec3 texel = normalTexel();
    vec3 mapped = texel.x * eyeTangent.xyz + texel.y * bitangent + texel.z * normal;
    return dot(mapped, mapped) < 1e-12 ? normal : unitVector(mapped);  // guard: texel without a direction
}

#piece derivatives
// Where a mesh has no tangents: along the picture's axes as they run from pixel to pixel, both divided by the longer one; the picture's
// y runs against its texture coordinate. Of coordinates that run the other way round the normal follows, too.
// Source: Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU, JGT 15 (2010); Schueler, Normal Mapping without Precomputed
//         Tangents, ShaderX 5 (2006); glTF 2.0, 3.9.3.
// Edges:  where neither position nor coordinates change, the picture's z is left.
#include <guards/unit_vector>
#include <normal>
#include <texture_placement/steps>
#include "normal_map/texel.glsl"

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() {
    vec3 normal = shadingDirection(eyeNormal);
    vec3 alongX = dFdx(eyePosition);
    vec3 alongY = dFdy(eyePosition);
    vec4 steps = mapSteps(2);
    float side = dot(normal, cross(alongX, alongY)) < 0.0 ? -1.0 : 1.0;  // as the picture shows it
    vec3 acrossY = side * cross(alongY, normal);
    vec3 acrossX = side * cross(normal, alongX);
    vec3 tangent = steps.x * acrossY + steps.z * acrossX;
    vec3 bitangent = -(steps.y * acrossY + steps.w * acrossX);
    float longer = max(dot(tangent, tangent), dot(bitangent, bitangent));
    vec3 texel = normalTexel();
    vec3 bent = (texel.x * tangent + texel.y * bitangent) * inversesqrt(max(longer, 1e-30));  // guard: nothing changes
    vec3 mapped = bent + texel.z * normal;
    return dot(mapped, mapped) < 1e-12 ? normal : unitVector(mapped);  // guard: texel without a direction
}
