// The ambient colour of a light in the arrays of an ubershader (L8, L9).
//
// Model:  L of K_a L.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Range:  0 to 1e5 (radiance).
// Edges:  none: passed on as it is.

/// A_l of the light that is about to be added.
vec3 ambientOfLight;
