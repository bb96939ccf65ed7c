// Which side of the surface is seen, in the fragment stage (S11).
//
// Model:  the front, where the triangle runs counter-clockwise on the screen; in a mirrored model, whose
//         triangles all run the other way round, where it runs clockwise.
// Edges:  a model without volume (a determinant of 0) counts as not mirrored (H-G1, H-G2).

/// Whether the surface's back is seen.
bool isBackVisible() { return gl_FrontFacing != (handedness > 0.0); }  // H-G2
