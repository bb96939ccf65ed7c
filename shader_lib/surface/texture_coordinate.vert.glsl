// Where on its textures the surface lies, in the vertex stage (S16).
//
// Model:  (s, t).
// Source: OpenGL 4 Shading Language Cookbook, ch. 4, Using Alpha Maps to Discard Pixels.
// Range:  within 1e3.
// Edges:  none: the attribute is passed on as it is.

ATTRIBUTE(4) vec2 texcoord;

/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return texcoord; }
