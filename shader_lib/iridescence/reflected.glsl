// What the surface mirrors, and what enters.

#piece none
// Without a film.
#include <pbr/interface.glsl>

#piece thin_film
// A film of some wavelengths' thickness: what its upper side reflects, and what comes back from beneath it once, twice and so on, adds up
// or cancels by wavelength. With c the cosine, c2 = sqrt(ior^2 - 1 + c^2) / ior that within the film, R12 and R23 what its upper and
// lower side reflect by Schlick, T = 1 - R12 and R = T^2 R23 / (1 - R12 R23):
// F = R12 + R + 2 sum over m = 1, 2 of (R - T) sqrt(R12 R23)^m S(2 m ior d c2), S the eye's answer to interference at that path.
// Source: Belcour, Barla, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence, TOG 36 (2017); the constants
//         and Schlick for both sides: KHR_materials_iridescence, which adds 1e-4 to f0 where the limit at 1 is taken here.
// Edges:  of a mirror the film shows nothing: F = 1. F is kept within 0 to 1, what a screen's colours can show and a surface may reflect.
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// How much of the surface has the film, 0 to 1; its index of refraction, at least 1; its thickness in nanometres.
BLOCK(22, Iridescence) {
    float factor;
    float ior;
    float thickness;
} iridescence;

/// S: how red, green and blue change at a path of so many micrometres; `phase` is 1, or -1 where a reflection turns it by half a wave. Fits
/// of X, Y, Z and the second peak of X: so many waves in a micrometre, fading as more wavelengths mix.
vec3 interference(float path, vec3 phase) {
    vec4 turns = path * vec4(1.681, 1.7953, 2.2084, 2.2399);
    vec4 fading = exp(-path * path * vec4(0.1708547, 0.36733088, 0.26103523, 0.17876618));
    vec4 sum = vec4(0.84659, 1.0002218, 1.0011225, 0.1538683) * fading * cos(6.2831855 * fract(turns));
    vec3 xyz = phase * vec3(sum.x, sum.yz) + vec3(phase.x * sum.w, 0.0, 0.0);
    return vec3(dot(vec3(3.2404542, -1.5371385, -0.4985314), xyz), dot(vec3(-0.969266, 1.8760108, 0.041556), xyz),
                dot(vec3(0.0556434, -0.2040259, 1.0572252), xyz));
}

/// What the film over the surface reflects at a cosine of 0 to 1.
vec3 filmReflectance(float cosine) {
    float ior = iridescence.ior;
    float inside = sqrt(ior * ior - 1.0 + cosine * cosine);
    float upper = (ior - 1.0) / (ior + 1.0);
    float r12 = upper * upper + (1.0 - upper * upper) * fifthPower(1.0 - cosine);
    vec3 root = sqrt(surface.f0);
    vec3 lower = (1.0 + root - ior * (1.0 - root)) / (1.0 + root + ior * (1.0 - root));
    vec3 r23 = lower * lower + (1.0 - lower * lower) * fifthPower(1.0 - inside / ior);
    vec3 both = clamp(r12 * r23, 0.0, 0.9999);  // guard: mirrors on both sides, or rounded below 0
    vec3 returned = (1.0 - r12) * (1.0 - r12) * r23 / (1.0 - both);
    vec3 wave = returned - (1.0 - r12);
    vec3 phase = 1.0 - 2.0 * vec3(greaterThanEqual(lower, vec3(0.0)));
    float path = 0.002 * iridescence.thickness * inside;
    vec3 once = wave * sqrt(both) * interference(path, phase);
    vec3 twice = wave * both * interference(2.0 * path, vec3(1.0));
    return clamp(r12 + returned + 2.0 * (once + twice), 0.0, 1.0);  // guard: colours that no screen has
}

/// The part of the light that is mirrored, by channel, where the surface without its film mirrors `bare` at the cosine, and one that mirrors
/// everything would mirror `whole`.
vec3 mirroredPart(vec3 bare, float cosine, float whole) { return mix(bare, whole * filmReflectance(cosine), iridescence.factor); }

/// The part that enters: as little as of the strongest channel, so that what is scattered does not take the opposite colour.
vec3 enteringPart(vec3 mirrored) {
    return vec3(max(1.0 - max(mirrored.r, max(mirrored.g, mirrored.b)), 0.0));  // guard: colours of vertices rounded above 1
}
