// A clear coat over the surface, of an index of refraction of 1.5.
//
// Source: KHR_materials_clearcoat; Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course notes.

#piece none
#include <light_sum>

/// Prepares the coat: there is none.
void beginCoat() {}

/// What of the radiance beneath gets through: all.
vec3 underCoat(vec3 radiance) { return radiance; }

/// Adds the coat's highlight of a light: none.
void addCoatHighlight(inout LightSum sum, vec3 toLight, vec3 light) {}

/// What the coat mirrors of the environment: nothing.
vec3 coatEnvironment() { return vec3(0.0); }

#piece layer
// mix(beneath, D V, c (0.04 + 0.96 (1 - n.v)^5)), c the factor; of an even environment the coat mirrors A + B of its own roughness.
// It lies on the normals of the mesh, whatever a picture makes of them beneath.
#include <distribution>
#include <environment_brdf>
#include <light_sum>
#include <normal_map/coat>
#include <reflection/mirrored>
#include <visibility>
#include "fresnel/fifth_power.glsl"
#include "pbr/surface.glsl"

/// Its normal and n.v, how much of what is seen is the coat, and the width of its slopes.
vec3 coatNormal;
float coatNv;
float coatWeight;
float coatAlpha;

/// Prepares the coat. To be called before all else of it, after beginSurface().
void beginCoat() {
    coatNormal = coatDirection();
    coatNv = max(dot(coatNormal, surface.toViewer), 1e-4);  // guard: normal that faces away
    coatWeight = material.clearcoat * (0.04 + 0.96 * fifthPower(1.0 - coatNv));
    float alpha = max(material.clearcoatRoughness * material.clearcoatRoughness, 0.002);  // guard: peak beyond what directions resolve
    coatAlpha = widenedAlpha(alpha);
}

/// What of the radiance beneath gets through.
vec3 underCoat(vec3 radiance) { return (1.0 - coatWeight) * radiance; }

/// Adds the coat's highlight of a light that arrives with irradiance `light` from the unit direction `toLight`.
void addCoatHighlight(inout LightSum sum, vec3 toLight, vec3 light) {
    float nl = dot(coatNormal, toLight);
    vec3 between = toLight + surface.toViewer;
    float square = dot(between, between);
    if (nl > 0.0 && square >= 1e-12) {  // guard: light from behind, or behind the viewer's ray
        float lobe = normalDistribution(coatNormal, coatAlpha, toLight, between, square) * visibilityTerm(coatAlpha, nl, coatNv, square);
        addTerm(sum, (coatWeight * nl * lobe) * light);
    }
}

/// What the coat mirrors of the environment.
vec3 coatEnvironment() {
    vec2 brdf = environmentBrdf(coatNv, material.clearcoatRoughness);
    return (coatWeight * (brdf.x + brdf.y)) * mirroredRadiance(coatNormal, material.clearcoatRoughness);
}
