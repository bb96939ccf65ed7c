// Point lights: at a position, the same in all directions, attenuated by distance.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Ranges: eye space; positions within 1e6, colour 0 to 1e5 (radiance at attenuation 1).

#piece point
#include <point_shadows>
#include <shading/point_ray>
#include <lighting/response>
#include "point/lights.glsl"

/// Adds every point light to the surface's response.
void addPointLights() {
    for (int i = 0; i < POINT_LIGHTS; ++i) {
        LightRay ray = pointRay(i);
        LIGHT_PRECISION float weight = ray.weight;
#if POINT_SHADOWS > 0
        if (i < POINT_SHADOWS) weight *= pointVisibility(i);
#endif
        addLightAmbient(ray.attenuation);
        addLight(ray.toLight, weight * pointLights.lights[i].color);
    }
}

#piece lights
/// `position` is in eye space, its w is 1; `attenuation` holds k_c, k_l, k_q.
struct PointLight {
    vec4 position;
    LIGHT_PRECISION vec3 color;
    vec3 attenuation;
};

BLOCK(5, PointLights) {
    PointLight lights[POINT_LIGHTS];
} pointLights;

#piece ray/point
// pointRay(), where there are such lights.
#include <shading/point_ray>
