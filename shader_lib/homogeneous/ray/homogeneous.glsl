// How a homogeneous light reaches the surface, where there are any: homogeneousRay() (L6).
//
// Model, source, space, edges: eitherRay().
#include "homogeneous/either_ray.glsl"
#include "homogeneous/lights.glsl"

/// The ray to light number i.
LightRay homogeneousRay(int i) {
    return eitherRay(homogeneousLights.lights[i].position, homogeneousLights.lights[i].attenuation);
}
