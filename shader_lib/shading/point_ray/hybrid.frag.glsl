// How a point light reaches the surface with hybrid shading (E3, L4).
//
// Space, ranges, edges: interpolatedRay().
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + i;
    return interpolatedRay(lightRays[i]);
}
