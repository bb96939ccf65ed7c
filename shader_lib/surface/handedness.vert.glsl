// Whether the model is mirrored, so that its triangles run the other way round (S11, H-G2).
//
// Model:  the sign of the model-view matrix's determinant: the view never mirrors.
// Source: OpenGL 4.5 core specification, 14.6.1: the sign of a triangle's area on the screen.
// Range:  the product of the three scales from 1e-37 to 1e37 or 0; result -1 or 1.
// Edges:  a model without volume counts as not mirrored (H-G1).
#include "surface/transform.vert.glsl"

/// -1 where the model is mirrored, else 1.
float handednessOfModel() { return determinant(mat3(transform.modelView)) < 0.0 ? -1.0 : 1.0; }  // H-G2
