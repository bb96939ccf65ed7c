// The shadow maps: what each shadowed light sees, as the depth of the nearest surface (S15).
//
// Model:  a map is drawn from its light by the family `depth`; all maps are layers of one array, so that a
//         stage has one sampler for any number of shadowed lights of any kind.
// Source: Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978; OpenGL Programming Guide, 9th
//         ed., ch. 7, Shadow Mapping.
// Space:  window space of the light: x, y and depth 0 to 1.
// Edges:  beside a map nothing is in shadow: visibility() does not ask there.

/// Compares `reference <= depth` (GL_COMPARE_REF_TO_TEXTURE, GL_LEQUAL). One level; wrapping does not matter.
SAMPLER(2, sampler2DArrayShadow) shadowMaps;
