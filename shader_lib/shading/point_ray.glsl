// How a point light reaches the surface: l = (P - p) / d, attenuated by distance. A light at the surface's own position
// comes from direction zero.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.

#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "point/lights.glsl"
#include "shading/light_ray.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    vec4 ray = directionAndLength(pointLights.lights[i].position.xyz - surfacePosition());
    float byDistance = attenuation(pointLights.lights[i].attenuation, ray.w);
    return LightRay(ray.xyz, byDistance, byDistance);
}

#piece hybrid.frag
// Interpolated between the vertices.
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + i;
    return interpolatedRay(lightRays[i]);
}
