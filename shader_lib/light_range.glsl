// How far a local light reaches, besides its attenuation.
//
// Source: KHR_lights_punctual, Range Property.

#piece point_ray/unlimited
#include "shading/point_ray.glsl"

#piece spot_ray/unlimited
#include "shading/spot_ray.glsl"

#piece point_ray/windowed
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "light_range/window.glsl"
#include "point/lights.glsl"
#include "shading/light_ray.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay pointRay(int i) {
    vec4 place = pointLights.lights[i].position;
    vec4 ray = directionAndLength(place.xyz - surfacePosition());
    float byDistance = attenuation(pointLights.lights[i].attenuation, ray.w) * rangeWindow(ray.w, place.w);
    return LightRay(ray.xyz, byDistance, byDistance);
}

#piece spot_ray/windowed
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "light_range/window.glsl"
#include "shading/light_ray.glsl"
#include "spot/cone.glsl"
#include "spot/lights.glsl"
#include "surface/position.glsl"

/// The ray to light number i.
LightRay spotRay(int i) {
    SpotLight light = spotLights.lights[i];
    vec4 ray = directionAndLength(light.position.xyz - surfacePosition());
    float cone = coneFactor(light.axis, -ray.xyz, light.innerOneMinusCosine, light.outerOneMinusCosine, light.exponent);
    float byDistance = attenuation(light.attenuation, ray.w) * rangeWindow(ray.w, light.position.w);
    return LightRay(ray.xyz, byDistance, cone * byDistance);
}

#piece window
// 1 - (d / range)^4, 0 from the range on: smooth there to its first derivative.
/// `nearness` is 1 / range, the w of a light's position; 0 has no end.
float rangeWindow(float d, float nearness) {
    float part = min(d * nearness, 1.0);  // guard: beyond the range
    float square = part * part;
    return 1.0 - square * square;
}
