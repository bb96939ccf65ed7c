// The sum of the lights' own ambient terms (L9).
//
// Model:  K_a sum A_l fading, with the attenuation of local lights. Outside a spot's cone its ambient term is
//         kept: the Cookbook keeps it, the Programming Guide drops it.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating a Spotlight; OpenGL Programming Guide, 9th
//         ed., ch. 7, Multiple Lights and Materials.
// Ranges: A_l 0 to 1e5 (radiance at attenuation 1), fading 0 to 1e18; result linear and unclamped.
// Edges:  it needs neither a normal nor a direction to the light (H-N1, H-L1).
#include <light_sum>
#include <material>
#include <vertex_color>

/// The ambient light so far.
LightSum ambientOfLights;

/// The radiance that the surface scatters of all ambient terms.
vec3 lightAmbientRadiance() { return tinted(material.ambient) * totalOf(ambientOfLights); }
