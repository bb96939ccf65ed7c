// How a point light reaches the surface with hybrid shading (E3, L4).
//
// Model:  (s, share) interpolated between the vertices.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Space, ranges, edges: interpolatedRay().
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + i;
    return interpolatedRay(lightRays[i]);
}
