// The direction to a viewer infinitely far away, the same everywhere (S6): cheaper, and the further the
// surface is from the middle of the picture, the further highlights are from where a camera sees them.
//
// Model:  v = +z.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light: its eye direction is a constant too.
// Space:  eye.
// Range:  unit.
// Edges:  none: the same everywhere.

/// The unit vector from the surface to the viewer, in eye space.
vec3 towardViewer() { return vec3(0.0, 0.0, 1.0); }
