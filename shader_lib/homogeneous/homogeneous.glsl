// Lights of either kind, directional or local, told apart by one vector's fourth component (L6).
//
// Model, source, edges: homogeneousRay().
// Space:  eye. Ranges: as the lights'.
#include <homogeneous/ray>
#include "lighting/response.glsl"

/// Adds every homogeneous light to the surface's response.
void addHomogeneousLights() {
    for (int i = 0; i < HOMOGENEOUS_LIGHTS; ++i) {
        LightRay ray = homogeneousRay(i);
        addLightAmbient(ray.fading);
        addLight(ray.toLight, ray.share * homogeneousLights.lights[i].color);
    }
}
