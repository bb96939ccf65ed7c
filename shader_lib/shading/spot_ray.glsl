// How a spot light reaches the surface: a point light times the factor of its cone.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual.

#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "shading/light_ray.glsl"
#include "spot/cone.glsl"
#include "spot/lights.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    SpotLight light = spotLights.lights[i];
    vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
    float cone = coneFactor(light.axis, -ray.xyz, light.innerOneMinusCosine, light.outerOneMinusCosine, light.exponent);
    float byDistance = attenuation(light.attenuation, ray.w);
    return LightRay(ray.xyz, byDistance, cone * byDistance);
}

#piece hybrid.frag
// Interpolated between the vertices. A cone's rim runs through faces: it is a ramp as wide as the face.
#include "shading/interpolated_ray.glsl"
#include "shading/light_number.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    lightNumber = DIRECTIONAL_LIGHTS + POINT_LIGHTS + i;
    return interpolatedRay(lightRays[POINT_LIGHTS + i]);
}
