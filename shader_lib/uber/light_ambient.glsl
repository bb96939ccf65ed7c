// The ambient colour of a light in the arrays of an ubershader (L8, L9).

/// A_l of the light that is about to be added.
vec3 ambientOfLight;
