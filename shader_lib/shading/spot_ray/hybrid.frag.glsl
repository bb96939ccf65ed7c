// How a spot light reaches the surface with hybrid shading (E3, L5). A cone's rim runs through faces: between
// vertices it is a ramp as wide as the face.
//
// Space, ranges, edges: interpolatedRay().
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + POINT_LIGHTS + i;
    return interpolatedRay(lightRays[POINT_LIGHTS + i]);
}
