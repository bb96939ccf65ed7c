// The highlight's lobe D V of the surface itself.

#piece none
// The same all round the normal.
#include <distribution>
#include <visibility>
#include "pbr/surface.glsl"

/// Prepares what all lobes share: nothing.
void beginHighlightLobe() {}

/// D V of the half vector along `sum`, the sum of the directions to light and viewer of squared length `square`, at the
/// cosine `nl` above 0 between normal and light.
float highlightLobe(vec3 toLight, vec3 sum, float square, float nl) {
    return normalDistribution(surface.normal, surface.alpha, toLight, sum, square) *
           visibilityTerm(surface.alpha, nl, surface.nv, square);
}

#piece brushed
// Wider along the direction in which the surface is brushed, by mix(a, 1, strength^2), a across it:
// D = 1 / (pi a_t a_b ((t.h / a_t)^2 + (b.h / a_b)^2 + (n.h)^2)^2), V as Smith's with lengths (a_t t.v, a_b b.v, n.v).
// Source: Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course notes; Heitz 2014; KHR_materials_anisotropy.
// Edges:  without tangents, or where they lie along the normal, t and b are zero: what is left is finite.
#include <guards/unit_vector>
#include "pbr/surface.glsl"

/// The surface's own axes, and the widths along them.
vec3 brushTangent;
vec3 brushBitangent;
float widthAlong;

/// Prepares what all lobes share. To be called before the first, after beginSurface().
void beginHighlightLobe() {
    vec3 n = surface.normal;
    vec3 t = unitVector(eyeTangent.xyz - n * dot(n, eyeTangent.xyz));
    vec3 b = eyeTangent.w * cross(n, t);
    brushTangent = material.anisotropyDirection.x * t + material.anisotropyDirection.y * b;
    brushBitangent = cross(n, brushTangent);
    widthAlong = mix(surface.alpha, 1.0, material.anisotropy * material.anisotropy);
}

/// The length of (a_t t.w, a_b b.w, n.w), `nw` being n.w.
float brushedLength(vec3 w, float nw) {
    vec3 scaled = vec3(widthAlong * dot(brushTangent, w), surface.alpha * dot(brushBitangent, w), nw);
    return sqrt(dot(scaled, scaled));
}

/// D V of the half vector along `sum`, the sum of the directions to light and viewer of squared length `square`, at the
/// cosine `nl` above 0 between normal and light.
float highlightLobe(vec3 toLight, vec3 sum, float square, float nl) {
    vec3 h = sum * inversesqrt(square);
    vec3 scaled = vec3(dot(brushTangent, h) / widthAlong, dot(brushBitangent, h) / surface.alpha, dot(surface.normal, h));
    float spread = max(dot(scaled, scaled), 0.05);  // guard: axes that do not span the space
    float peak = 3.1415927 * widthAlong * surface.alpha * spread * spread;
    float masking = nl * brushedLength(surface.toViewer, surface.nv) + surface.nv * brushedLength(toLight, nl);
    return 0.5 / (peak * masking);
}
