// The sheen of cloth: light scattered back at grazing angles by fibres that stand up from the surface.
//
// Source: Estevez, Kulla, Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017 course notes; KHR_materials_sheen.

#piece none
/// Prepares the sheen: there is none.
void beginSheen() {}

/// What of the radiance beneath gets through: all.
vec3 underSheen(vec3 radiance) { return radiance; }

/// The same of a light at the cosine `nl`: all.
vec3 underSheen(vec3 radiance, float nl) { return radiance; }

/// The sheen of a light: none.
vec3 sheenHighlight(vec3 toLight, vec3 sum, float square, float nl) { return vec3(0.0); }

/// The sheen of the ambient light: none.
vec3 sheenEnvironment() { return vec3(0.0); }

#piece charlie
// Charlie's distribution, D = (2 + 1 / a) sin^(1 / a) / (2 pi), with V = 1 / (4 n.l n.v (1 + L(n.v) + L(n.l))). Of what lies beneath
// min(1 - s E(n.v), 1 - s E(n.l)) is left, s the largest channel of the colour, E the albedo of the sheen alone. Ambient light counts as
// even: c E(n.v) A.
// Edges:  alpha is at least 0.07: below it the model sends back more than it receives. E is a fit, within 0.03 of the integral from
//         cosines of 0.003 on.
#include <ambient>
#include "pbr/surface.glsl"

/// The width of the fibres' directions, the largest channel of the colour, and what n.v decides: E and L.
float sheenAlpha;
float sheenStrength;
float sheenSeen;
float sheenMasking;

/// The exponent of L.
float sheenExponent(float x, float weight) {
    float power = pow(x, mix(0.19823, 0.16801, weight));
    return mix(21.5473, 25.3245, weight) / (1.0 + mix(3.82987, 3.32435, weight) * power) + mix(-1.9776, -1.27393, weight) * x +
           mix(-4.32054, -4.85967, weight);
}

/// L, what Smith's term of a direction at that cosine of 0 to 1 amounts to. Source: Estevez, Kulla, equation 3 and the table below it.
float sheenShadow(float cosine) {
    float weight = (1.0 - sheenAlpha) * (1.0 - sheenAlpha);
    if (cosine < 0.5) return exp(sheenExponent(cosine, weight));
    return exp(2.0 * sheenExponent(0.5, weight) - sheenExponent(1.0 - cosine, weight));
}

/// E: what a white sheen sends back of even light, at a cosine of 0 to 1.
float sheenAlbedo(float cosine) {
    float r = sqrt(sheenAlpha);
    vec4 byCosine = vec4(0.968151, -5.64098, 8.59661, -3.98256) +
                    cosine * (vec4(-11.9792, 31.6348, -36.0005, 13.8504) + cosine * vec4(4.20783, -15.6925, 21.3047, -8.95853));
    return min(exp(dot(byCosine, vec4(1.0, r, r * r, r * r * r))), 1.0);  // guard: a fit that exceeds 1
}

/// Prepares the sheen. To be called before all else of it, after beginSurface().
void beginSheen() {
    sheenAlpha = max(material.sheenRoughness * material.sheenRoughness, 0.07);  // guard: more light than arrives
    sheenStrength = max(material.sheenColor.r, max(material.sheenColor.g, material.sheenColor.b));
    float nv = min(surface.nv, 1.0);  // guard: rounded above 1
    sheenSeen = sheenAlbedo(nv);
    sheenMasking = sheenShadow(nv);
}

/// What of the radiance beneath gets through.
vec3 underSheen(vec3 radiance) { return (1.0 - sheenStrength * sheenSeen) * radiance; }

/// The same of a light at the cosine `nl`.
vec3 underSheen(vec3 radiance, float nl) {
    return (1.0 - sheenStrength * max(sheenSeen, sheenAlbedo(nl))) * radiance;
}

/// The sheen of a light, per solid angle, of the half vector along `sum` of squared length `square`.
vec3 sheenHighlight(vec3 toLight, vec3 sum, float square, float nl) {
    vec3 across = cross(surface.normal, toLight) + cross(surface.normal, surface.toViewer);
    float sineSquared = min(dot(across, across) / square, 1.0);
    float peak = (2.0 + 1.0 / sheenAlpha) * pow(sineSquared, 0.5 / sheenAlpha);
    float cosine = clamp(nl, 1e-4, 1.0);  // guard: light along the surface, or above 1 by a rounding
    float masking = 4.0 * surface.nv * cosine * (1.0 + sheenMasking + sheenShadow(cosine));
    return (peak / (6.2831855 * masking)) * material.sheenColor;
}

/// The sheen of the ambient light.
vec3 sheenEnvironment() { return sheenSeen * material.sheenColor * ambientLight(); }
