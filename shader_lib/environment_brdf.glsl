// The part of an even environment that the surface mirrors, by n.v and roughness, 0 to 1: A and B of A f0 + B f90, the integral of the
// distribution, the visibility and Schlick's Fresnel over all lights.

#piece table
// From a texture that is made once (gobo/environment_brdf.hpp), n.v along s and roughness along t.
// Source: Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course notes.
/// A and B, 32 texels a side or more, GL_LINEAR, GL_CLAMP_TO_EDGE. One level.
SAMPLER(5, sampler2D) environmentBrdfTable;

/// A and B.
vec2 environmentBrdf(float nv, float roughness) { return textureLod(environmentBrdfTable, vec2(nv, roughness), 0.0).xy; }

#piece karis
// A polynomial and an exponential. Source: Karis, Physically Based Shading on Mobile (2014), after Lazarov, Getting More Physical in
// Call of Duty: Black Ops II, SIGGRAPH 2013 course notes.
/// A and B.
vec2 environmentBrdf(float nv, float roughness) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    return clamp(vec2(-1.04, 1.04) * a + r.zw, 0.0, 1.0);  // guard: rounded out of its range
}

#piece lazarov
// The fit that Karis' came from, of gloss 1 - roughness; 1 / 0.96 and so on, since it was made for f0 from 0.04 to 1.
// Source: Lazarov, Getting More Physical in Call of Duty: Black Ops II, SIGGRAPH 2013 course notes.
/// A and B.
vec2 environmentBrdf(float nv, float roughness) {
    float gloss = 1.0 - roughness;
    float b = (gloss / 0.96) * min(0.475 * gloss, exp2(-9.28 * nv)) + (0.0175 * gloss - 0.015) / 0.96;
    float both = 0.75 + 0.25 * gloss;
    return vec2(both - b, max(b, 0.0));  // guard: a fit that falls below 0
}

#piece constant
// As if every surface were smooth and seen head-on: f0.
/// A and B.
vec2 environmentBrdf(float nv, float roughness) { return vec2(1.0, 0.0); }
