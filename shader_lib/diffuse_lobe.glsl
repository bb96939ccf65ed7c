// How the light that is not mirrored is scattered, with the diffuse colour: per solid angle, at the cosine `nl` above 0; `vh` is the
// cosine of half the angle between light and viewer.

#piece oren_nayar
// Oren and Nayar's model of rough matte surfaces, with the light that is scattered more than once given back: of albedo 1, all
// of it is.
// Source: Portsmouth, Kutz, Hill, EON: A Practical Energy-Preserving Rough Diffuse BRDF, JCGT 14 (2025), eq. 3, 4, 25 and
//         their fit of the albedo.
#include "pbr/surface.glsl"

/// The albedo of single scattering at a cosine of 0 to 1, at roughness `r`, before its norm.
float singleScattering(float cosine, float r) {
    float m = 1.0 - cosine;
    return 1.0 + r * m * (0.05710853 + m * (0.49188188 + m * (-0.33218145 + m * 0.071443)));
}

/// What is scattered towards the viewer.
vec3 diffuseLobe(vec3 toLight, float nl, float vh) {
    float r = surface.roughness;
    float nv = surface.nv;
    float norm = 1.0 / (1.0 + 0.2877934 * r);  // 1/2 - 2 / (3 pi)
    float s = dot(toLight, surface.toViewer) - nl * nv;
    float single = 1.0 + r * (s > 0.0 ? s / max(nl, nv) : s);
    float average = norm * (1.0 + 0.07248821 * r);  // 2/3 - 28 / (15 pi)
    float lost = max(1.0 - average, 1e-7);  // guard: roughness 0 loses nothing
    float again = max(1.0 - norm * singleScattering(nv, r), 0.0) * max(1.0 - norm * singleScattering(nl, r), 0.0) / lost;
    vec3 rho = surface.diffuse;
    return (rho * (norm * max(single, 0.0)) + rho * rho * (average * again) / (1.0 - rho * lost)) / 3.1415927;
}

#piece burley
// Darker or brighter edges by roughness. Source: Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course notes, 5.3.
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// What is scattered towards the viewer.
vec3 diffuseLobe(vec3 toLight, float nl, float vh) {
    float edge = 2.0 * surface.roughness * vh * vh - 0.5;  // F_D90 - 1
    float incoming = 1.0 + edge * fifthPower(1.0 - nl);
    float outgoing = 1.0 + edge * fifthPower(1.0 - surface.nv);
    return (incoming * outgoing / 3.1415927) * surface.diffuse;
}

#piece lambert
// The same to all sides: c_d / pi.
#include "pbr/surface.glsl"

/// What is scattered towards the viewer.
vec3 diffuseLobe(vec3 toLight, float nl, float vh) { return surface.diffuse / 3.1415927; }
