// Each light brings ambient light of its own (L9).
//
// Model:  K_a sum A_l fading, with the attenuation of local lights. Outside a spot's cone its ambient term is
//         kept: the Cookbook keeps it, the Programming Guide drops it.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating a Spotlight; OpenGL Programming Guide, 9th
//         ed., ch. 7, Multiple Lights and Materials.
// Ranges: A_l 0 to 1e5 (radiance at attenuation 1), fading 0 to 1e18; result linear and unclamped.
// Edges:  it needs neither a normal nor a direction to the light (H-N1, H-L1).
#include <material>
#include <vertex_color>
#include <light_sum>

/// A_l of each light: first the directional ones, then point, spot and homogeneous lights.
BLOCK(13, LightAmbients) {
    vec3 colors[DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + HOMOGENEOUS_LIGHTS];
} lightAmbients;

/// The ambient light so far, and the number of the next light.
LightSum ambientOfLights;
int nextLight;

/// Prepares the sum of the lights' ambient terms. To be called before the first light.
void beginLightAmbient() {
    ambientOfLights = emptySum();
    nextLight = 0;
}

/// Adds the ambient term of the next light, weakened by `fading`.
void addLightAmbient(float fading) {
    addTerm(ambientOfLights, fading * lightAmbients.colors[nextLight]);
    ++nextLight;
}

/// The radiance that the surface scatters of all ambient terms.
vec3 lightAmbientRadiance() { return tinted(material.ambient) * totalOf(ambientOfLights); }
