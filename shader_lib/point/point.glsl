// Point lights: they shine from a position to all sides alike (L4).
//
// Model:  s = (P - p) / d, attenuated by distance.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Space:  eye. Ranges: as the lights'.
// Edges:  a light at the surface's own position gives no light (H-L1).
#include <point_shadows>
#include <shading/point_ray>
#include "lighting/response.glsl"
#include "point/lights.glsl"

/// Adds every point light to the surface's response.
void addPointLights() {
    for (int i = 0; i < POINT_LIGHTS; ++i) {
        LightRay ray = pointRay(i);
        float share = ray.share;
#if POINT_SHADOWS > 0
        if (i < POINT_SHADOWS) share *= pointVisibility(i);
#endif
        addLightAmbient(ray.fading);
        addLight(ray.toLight, share * pointLights.lights[i].color);
    }
}
