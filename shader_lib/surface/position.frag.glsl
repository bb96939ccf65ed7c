// The surface's position in the fragment stage: interpolated in eye space (E4).
//
// Model:  p.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Using Per-fragment Shading.
// Space:  eye.
// Range:  within 1e6.
// Edges:  none: interpolated as it is.

/// The position of the surface in eye space.
vec3 surfacePosition() { return eyePosition; }
