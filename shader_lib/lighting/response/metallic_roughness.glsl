// The response of a metallic-roughness surface to its lights: sum (f_d + f_s) n.l E, where E is what a surface that faces the
// light would receive: lux of a directional light, candela over the squared distance of a local one. f_s = F D V with
// D the distribution of normals, V the visibility and F Fresnel's reflectance; f_d is what is not reflected, scattered.
//
// Source: glTF 2.0, appendix B; Walter, Marschner, Li, Torrance, Microfacet Models for Refraction through Rough Surfaces,
//         EGSR 2007.
// Edges:  a light gives exactly nothing unless n.l > 0; directly behind the viewer's ray there is no half vector, and no
//         highlight.

#include <anisotropy>
#include <clearcoat>
#include <diffuse_lobe>
#include <fresnel>
#include <light_sum>
#include <multiple_scattering>
#include <sheen>
#include "light_ambient/none.glsl"
#include "pbr/interface.glsl"
#include "pbr/surface.glsl"

/// What is reflected of the lights so far, and what every highlight is multiplied by.
LightSum reflectedSum;
vec3 scaleOfHighlights;

/// Prepares what all lights share. To be called before the first light, and after beginSurface().
void beginResponse() {
    reflectedSum = emptySum();
    scaleOfHighlights = highlightScale();
    beginHighlightLobe();
}

/// The part of the light from the unit direction `toLight`, at the cosine `nl` to the normal, that leaves towards the
/// viewer, per solid angle.
vec3 reflectance(vec3 toLight, float nl) {
    vec3 sum = toLight + surface.toViewer;
    float square = dot(sum, sum);
    float vh = 0.5 * sqrt(square);  // the cosine of half the angle between the two
    vec3 mirrored = mirroredPart(fresnelReflectance(vh), vh, 1.0);
    vec3 diffuse = enteringPart(mirrored) * diffuseLobe(toLight, nl, vh);
    if (square < 1e-12) return underCoat(underSheen(diffuse, nl));  // guard: light behind the viewer's ray
    vec3 reflected = diffuse + scaleOfHighlights * mirrored * highlightLobe(toLight, sum, square, nl);
    return underCoat(underSheen(reflected, nl) + sheenHighlight(toLight, sum, square, nl));
}

/// Adds a light that arrives with irradiance `light` from the unit direction `toLight` (zero: from nowhere).
void addLight(vec3 toLight, vec3 light) {
    float nl = dot(surface.normal, toLight);
    if (nl > 0.0) addTerm(reflectedSum, (nl * light) * reflectance(toLight, nl));  // guard: light from behind; NaN does not pass
    addCoatHighlight(reflectedSum, toLight, light);
}

/// The radiance that the surface reflects of all lights added.
vec3 responseRadiance() { return totalOf(reflectedSum); }
