// How a point light reaches the surface, computed where the model is evaluated (L4).
//
// Model:  s = (P - p) / d, attenuated by distance.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Space:  eye. Range: as directionAndLength() and attenuation().
// Edges:  a light at the surface's own position comes from direction zero (H-L1).
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "point/lights.glsl"
#include "shading/light_ray.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    vec4 ray = directionAndLength(pointLights.lights[i].position.xyz - surfacePosition());
    float fading = attenuation(pointLights.lights[i].attenuation, ray.w);
    return LightRay(ray.xyz, fading, fading);
}
