// How much a smooth surface reflects: f0 at normal incidence, more towards grazing. `vh` is the cosine of half the angle between
// light and viewer, 0 to 1.

#piece exact
// A dielectric by Fresnel's equations for unpolarised light, its index of refraction from f0: eta = (1 + sqrt f0) / (1 - sqrt f0),
// F = (g - c)^2 / (g + c)^2 (1 + (c (g + c) - 1)^2 / (c (g - c) + 1)^2) / 2, g^2 = eta^2 - 1 + c^2. Metals as with `schlick`: their
// curve needs an absorption that glTF does not have.
// Source: Cook, Torrance, A Reflectance Model for Computer Graphics, TOG 1 (1982); KHR_materials_ior.
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// One channel of a dielectric of that f0.
float dielectricReflectance(float f0, float c) {
    float root = min(sqrt(f0), 0.999);  // guard: no index of refraction reflects all
    float eta = (1.0 + root) / (1.0 - root);
    float g = sqrt(max(eta * eta - 1.0 + c * c, 1e-12));  // guard: an index of 1 seen edge on
    float parallel = (g - c) / (g + c);
    float ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * parallel * parallel * (1.0 + ratio * ratio);
}

/// The part of the light that is reflected, by channel.
vec3 fresnelReflectance(float vh) {
    float edge = material.dielectricEdge;
    vec3 f0 = edge > 0.0 ? min(material.dielectric / edge, vec3(1.0)) : vec3(0.0);  // guard: nothing is reflected
    float c = min(vh, 1.0);
    vec3 dielectric = edge * vec3(dielectricReflectance(f0.r, c), dielectricReflectance(f0.g, c), dielectricReflectance(f0.b, c));
    vec3 metal = surface.base + (1.0 - surface.base) * fifthPower(1.0 - c);
    return mix(dielectric, metal, surface.metallic);
}

#piece schlick
// f0 + (f90 - f0) (1 - vh)^5. Source: Schlick, An Inexpensive BRDF Model for Physically-based Rendering, Eurographics 1994.
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// The part of the light that is reflected, by channel.
vec3 fresnelReflectance(float vh) {
    return surface.f0 + (surface.f90 - surface.f0) * fifthPower(max(1.0 - vh, 0.0));  // guard: rounded out of its range
}

#piece gaussian
// With exp2((-5.55473 vh - 6.98316) vh) for the fifth power. Source: Lagarde, Spherical Gaussian approximation for Blinn-Phong,
// Phong and Fresnel (2012); Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course notes.
#include "pbr/surface.glsl"

/// The part of the light that is reflected, by channel.
vec3 fresnelReflectance(float vh) {
    float weight = exp2((-5.55473 * vh - 6.98316) * vh);
    return surface.f0 + (surface.f90 - surface.f0) * weight;
}

#piece constant
// f0 at every angle: no brighter edge.
#include "pbr/surface.glsl"

/// The part of the light that is reflected, by channel.
vec3 fresnelReflectance(float vh) { return surface.f0; }

#piece fifth_power
/// x^5 for 0 to 1, and what a rounding leaves below 0.
float fifthPower(float x) {
    float square = x * x;
    return square * square * x;
}
