// The tangent of normal maps, at the vertex. Source: glTF 2.0, 3.7.2.1, for the sign; MikkTSpace (Mikkelsen 2008).
// M t / |M t|; a mirrored model turns the bitangent round, as the cross product of normal and tangent does not.
#include <guards/unit_vector>
#include "surface/handedness.vert.glsl"
#include "surface/transform.vert.glsl"

ATTRIBUTE(6) vec4 tangent;

/// The unit tangent in eye space, zero where there is none, and the bitangent's sign.
vec4 surfaceTangent() {
    return vec4(unitVector(mat3(transform.modelView) * tangent.xyz), tangent.w * handednessOfModel());
}
