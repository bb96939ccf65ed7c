// The surface's response to its lights, diffuse and specular summed apart: K_d sum f_d(n.l) L + K_s sum f_s L, L after
// attenuation. Linear and unclamped.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7: highlights do not have the surface's colour.
// Edges:  a light gives exactly nothing unless n.l > 0: neither from behind nor where there is no normal or direction.

#include <diffuse>
#include <n_dot_l>
#include <light_ambient>
#include <material>
#include <sides>
#include <specular>
#include <vertex_color>
#include <light_sum>

/// The normal to shade with, and the diffuse light so far.
vec3 litNormal;
LightSum diffuseSum;

/// Prepares what all lights share. To be called before the first light.
void beginResponse() {
    litNormal = visibleNormal();
    diffuseSum = emptySum();
    beginCosines();
    beginDiffuse();
    beginLightAmbient();
    beginHighlights();
}

/// Adds a light that arrives with radiance `light` from the unit direction `toLight` (zero: from nowhere).
void addLight(vec3 toLight, vec3 light) {
    float cosine = nextCosine(litNormal, toLight);
    if (cosine > 0.0) {  // guard: light from behind; NaN does not pass
        addTerm(diffuseSum, diffuseTerm(cosine, light));
        addHighlight(litNormal, toLight, light);
    }
}

/// The radiance that the surface reflects of all lights added.
vec3 responseRadiance() {
    vec3 diffuse = tinted(material.diffuse) * limitedDiffuse(totalOf(diffuseSum));
    return diffuse + highlightRadiance() + lightAmbientRadiance();
}
