// A clear coat over the surface, of an index of refraction of 1.5.
//
// Source: KHR_materials_clearcoat; Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course notes.

#piece none
/// Prepares the coat: there is none.
void beginCoat() {}

/// What of the radiance beneath gets through: all.
vec3 underCoat(vec3 radiance) { return radiance; }

/// The coat's highlight: none.
float coatHighlight(vec3 toLight, vec3 sum, float square, float nl) { return 0.0; }

/// What the coat mirrors of the environment: nothing.
vec3 coatEnvironment() { return vec3(0.0); }

#piece layer
// mix(beneath, D V, c (0.04 + 0.96 (1 - n.v)^5)), c the factor; of an even environment the coat mirrors A + B of its own roughness.
// It lies on the same normals as the surface.
#include <distribution>
#include <environment_brdf>
#include <reflection/mirrored>
#include <visibility>
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// How much of what is seen is the coat, and the width of its slopes.
float coatWeight;
float coatAlpha;

/// Prepares the coat. To be called before all else of it, after beginSurface().
void beginCoat() {
    coatWeight = material.clearcoat * (0.04 + 0.96 * fifthPower(1.0 - surface.nv));
    coatAlpha = max(material.clearcoatRoughness * material.clearcoatRoughness, 0.002);  // guard: peak beyond what directions resolve
}

/// What of the radiance beneath gets through.
vec3 underCoat(vec3 radiance) { return (1.0 - coatWeight) * radiance; }

/// The coat's highlight.
float coatHighlight(vec3 toLight, vec3 sum, float square, float nl) {
    return coatWeight * normalDistribution(surface.normal, coatAlpha, toLight, sum, square) *
           visibilityTerm(coatAlpha, nl, surface.nv, square);
}

/// What the coat mirrors of the environment.
vec3 coatEnvironment() {
    vec2 brdf = environmentBrdf(surface.nv, material.clearcoatRoughness);
    return (coatWeight * (brdf.x + brdf.y)) * mirroredRadiance(material.clearcoatRoughness);
}
