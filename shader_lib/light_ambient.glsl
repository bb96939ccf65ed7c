// An ambient term for each light: K_a sum A_l attenuation. A spot light's applies outside its cone too, as in the
// Cookbook; the Programming Guide drops it there. It needs neither a normal nor a direction to the light.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating a Spotlight; OpenGL Programming Guide, 9th ed., ch. 7,
//         Multiple Lights and Materials.

#piece none
/// Prepares the sum of the lights' ambient terms: there is none.
void beginLightAmbient() {}

/// Adds the ambient term of the next light: none.
void addLightAmbient(float byDistance) {}

/// The radiance that the surface reflects of all ambient terms.
vec3 lightAmbientRadiance() { return vec3(0.0); }

#piece each
// Numbered as the lights are.
#include "light_ambient/sum.glsl"

/// A_l of each light: first the directional ones, then point, spot lights, and those of either kind.
BLOCK(13, LightAmbients) {
    vec3 colors[DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + DIRECTIONAL_OR_POINT_LIGHTS];
} lightAmbients;

/// The number of the next light.
int nextLight;

/// Prepares the sum of the lights' ambient terms. To be called before the first light.
void beginLightAmbient() {
    ambientOfLights = emptySum();
    nextLight = 0;
}

/// Adds the ambient term of the next light, weakened by its distance.
void addLightAmbient(float byDistance) {
    addTerm(ambientOfLights, byDistance * lightAmbients.colors[nextLight]);
    ++nextLight;
}

#piece sum
#include <light_sum>
#include <material>
#include <vertex_color>

/// The ambient light so far.
LightSum ambientOfLights;

/// The radiance that the surface reflects of all ambient terms.
vec3 lightAmbientRadiance() { return tinted(material.ambient) * totalOf(ambientOfLights); }
