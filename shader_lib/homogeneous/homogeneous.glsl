// Lights of either kind, directional or local, told apart by one vector's fourth component (L6).
//
// Model, source, edges: eitherRay().
// Space:  eye. Ranges: components within 1e6, colour 0 to 1e5 (radiance at attenuation 1).
#include "homogeneous/either_ray.glsl"
#include "lighting/response.glsl"

/// `position` is a point in eye space, times its w; or where w is 0 the direction to the light, of any length.
/// `attenuation` holds k_c, k_l, k_q, which a direction does not need.
struct HomogeneousLight {
    vec4 position;
    vec3 color;
    vec3 attenuation;
};

BLOCK(11, HomogeneousLights) {
    HomogeneousLight lights[HOMOGENEOUS_LIGHTS];
} homogeneousLights;

/// Adds every homogeneous light to the surface's response.
void addHomogeneousLights() {
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i) {
        HomogeneousLight light = homogeneousLights.lights[i];
        LightRay ray = eitherRay(light.position, light.attenuation);
        addLightAmbient(ray.fading);
        addLight(ray.toLight, ray.share * light.color);
    }
}
