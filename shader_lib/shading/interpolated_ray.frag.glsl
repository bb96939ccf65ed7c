// How a local light reaches the surface with hybrid shading (E3): direction and share come from the vertices.
//
// Model:  (s, share) interpolated between the vertices.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Space:  eye. Ranges: interpolated directions of length 0 to 1, shares 0 to 1e18.
// Edges:  an interpolated share may leave its range by a rounding; light is not negative (H-I1).
#include <normal>
#include "shading/light_ray.glsl"

/// An interpolated ray, its direction as the key has normals. What the cone leaves is not told from fading.
LightRay interpolatedRay(vec4 ray) {
    float share = max(ray.w, 0.0);  // H-I1
    return LightRay(shadingDirection(ray.xyz), share, share);
}
