// Which side of the surface is seen, in the fragment stage (S11).
//
// Model:  the front, where the triangle runs counter-clockwise on the screen; in a mirrored model, whose
//         triangles all run the other way round, where it runs clockwise.
// Source: OpenGL 4.5 core specification, 14.6.1; OpenGL 4 Shading Language Cookbook, ch. 2, Implementing
//         Two-sided Shading.
// Range:  front or back.
// Edges:  a model without volume (a determinant of 0) counts as not mirrored (H-G1, H-G2).

/// Whether the surface's back is seen.
bool isBackVisible() { return gl_FrontFacing != (handedness > 0.0); }  // H-G2
