// Whether the surface is lit; ambient light; attenuation by distance.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7; glTF 2.0 KHR_materials_unlit.

#piece lit
// The whole lighting model.
#include "lighting/radiance.glsl"

#piece unlit
// The diffuse colour itself, tinted by the vertices' colour where there is one.
#include <material>
#include <vertex_color>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    chooseMaterial();
    return tinted(material.diffuse);
}

#piece ambient
// K_a A; reaches a surface without a normal, too.
#include <ambient>
#include <material>
#include <vertex_color>

/// The ambient light that the surface reflects.
vec3 ambientRadiance() { return tinted(material.ambient) * ambientLight(); }

#piece attenuation
// 1 / (k_c + k_l d + k_q d^2). All coefficients may be 0: the result ends at 1e18. A distance beyond 1e17 counts as 1e17,
// where nothing is left of the light.
/// The factor by which a light at a distance d is weakened.
float attenuation(vec3 coefficients, float d) {
    float reach = min(d, 1e17);  // guard: the square does not overflow
    float denominator = coefficients.x + reach * (coefficients.y + reach * coefficients.z);
    return 1.0 / max(denominator, 1e-18);  // guard: no attenuation
}
