// Light that microfacets mirror more than once, which the model of one reflection loses: up to half of it at roughness 1.

#piece returned
// Of lights, Turquin: the highlight times 1 + f0 (1 / E - 1), E = A + B the part of the light that leaves after one reflection. Of the
// environment, Fdez-Aguera: F_ms = (f0 A + f90 B) G (1 - E) / (1 - G (1 - E)), G = f0 + (f90 - f0) / 21 the mean reflectance.
// Source: Turquin, Practical Multiple Scattering Compensation for Microfacet Models (2019); Fdez-Aguera, A Multiple-Scattering
//         Microfacet Model for Real-Time Image-based Lighting, JCGT 8 (2019).
#include <environment_brdf>
#include "pbr/surface.glsl"

/// The part of an even environment that leaves after more than one reflection, where `once` leaves after one.
vec3 returnedToEnvironment(vec2 brdf, vec3 once) {
    float lost = max(1.0 - brdf.x - brdf.y, 0.0);  // guard: a fit that exceeds 1
    vec3 mean = surface.f0 + (surface.f90 - surface.f0) / 21.0;
    return once * mean * lost / max(1.0 - mean * lost, 1e-3);  // guard: nothing leaves
}

/// What highlights are multiplied by.
vec3 highlightScale() {
    vec2 brdf = environmentBrdf(surface.nv, surface.roughness);
    float once = clamp(brdf.x + brdf.y, 0.1, 1.0);  // guard: a table of zeros
    return 1.0 + surface.f0 * (1.0 / once - 1.0);
}

#piece none
/// The part of an even environment that leaves after more than one reflection: none.
vec3 returnedToEnvironment(vec2 brdf, vec3 once) { return vec3(0.0); }

/// What highlights are multiplied by: 1.
vec3 highlightScale() { return vec3(1.0); }
