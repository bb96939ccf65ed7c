// The colour of the vertices tints scattered light, ambient and diffuse; highlights keep theirs (S17).
//
// Model:  C K, per channel.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: Color.rgb * scatteredLight + reflectedLight.
// Ranges: colours 0 to 1; result 0 to 1.
// Edges:  as surfaceColor(): never negative (H-I1).
#include "surface/color.glsl"

/// The reflectivity that scatters light.
vec3 tinted(vec3 reflectivity) { return surfaceColor().rgb * reflectivity; }
