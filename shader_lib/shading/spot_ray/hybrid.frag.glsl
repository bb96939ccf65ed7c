// How a spot light reaches the surface with hybrid shading (E3, L5). A cone's rim runs through faces: between
// vertices it is a ramp as wide as the face.
//
// Model:  (s, share) interpolated between the vertices.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Space, ranges, edges: interpolatedRay().
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + POINT_LIGHTS + i;
    return interpolatedRay(lightRays[POINT_LIGHTS + i]);
}
