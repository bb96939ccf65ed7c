// Spot lights: point lights with a cone.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual for the inner cone and the
//         edge.
// Ranges: eye space; as point lights, 1 - cos of half angles 0 to 2, exponent 0 to 1e6, axis unit.

#piece spot
#include <shading/spot_ray>
#include <spot_shadows>
#include <lighting/response>
#include "spot/lights.glsl"

/// Adds every spot light to the surface's response.
void addSpotLights() {
    for (int i = 0; i < SPOT_LIGHTS; ++i) {
        LightRay ray = spotRay(i);
        LIGHT_PRECISION float weight = ray.weight;
#if SPOT_SHADOWS > 0
        if (i < SPOT_SHADOWS) weight *= spotVisibility(i);
#endif
        addLightAmbient(ray.attenuation);  // outside the cone too
        addLight(ray.toLight, weight * spotLights.lights[i].color);
    }
}

#piece lights
/// `position` is in eye space, its w is 1; `axis` is the unit vector along which the light shines. The
/// cone is given by 1 - cos of its half angles, which hold an angle of 1e-4 as well as
/// one of 90 degrees; `attenuation` holds k_c, k_l, k_q.
struct SpotLight {
    vec4 position;
    LIGHT_PRECISION vec3 color;
    float exponent;
    vec3 attenuation;
    float innerOneMinusCosine;
    vec3 axis;
    float outerOneMinusCosine;
};

BLOCK(6, SpotLights) {
    SpotLight lights[SPOT_LIGHTS];
} spotLights;

#piece ray/spot
// spotRay(), where there are such lights.
#include <shading/spot_ray>

#piece cone
// e(u) c^exponent with u = 1 - c, c the cosine of the angle to the axis, and the edge e: 1 up to the inner angle, 0 from
// the outer angle on, between them ((u_outer - u) / (u_outer - u_inner))^2. Outer angle 0 is nothing, 90 degrees the half
// space, 180 degrees everything; inner = outer is a hard edge; it is true to 0.3 % of the angle down to 1e-4 radians.
#include <spot_edge>
#include "power/exact.glsl"

/// The edge. The comparisons come first, so that only inner < outer reaches the division.
float coneEdge(float oneMinusCosine, float innerOneMinusCosine, float outerOneMinusCosine) {
    if (oneMinusCosine >= outerOneMinusCosine) return 0.0;
    if (oneMinusCosine <= innerOneMinusCosine) return 1.0;  // guard: hard edge
    LIGHT_PRECISION float fade = (outerOneMinusCosine - oneMinusCosine) / (outerOneMinusCosine - innerOneMinusCosine);
    return fade * fade;
}

/// How much of the light there is on the unit vector `ray`, which leads away from the light.
float coneFactor(vec3 axis, vec3 ray, float innerOneMinusCosine, float outerOneMinusCosine, float exponent) {
    float oneMinusCosine = min(coneOneMinusCosine(axis, ray), 1.9999998);  // guard: 180 degrees holds all directions
    return coneEdge(oneMinusCosine, innerOneMinusCosine, outerOneMinusCosine) * cosinePower(oneMinusCosine, exponent);
}
