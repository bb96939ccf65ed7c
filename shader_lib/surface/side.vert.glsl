// Which side of the surface is asked for, in the vertex stage, where both are shaded (S11).
//
// Model:  both, one after the other.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading.
// Range:  front or back.
// Edges:  none: the fragment stage chooses between the two.

/// Set to ask for the back's radiance.
bool backIsAsked = false;

/// Whether the surface's back is seen.
bool isBackVisible() { return backIsAsked; }
