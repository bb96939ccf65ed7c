// Where on its textures the surface lies, in the fragment stage: interpolated (S16).
//
// Model:  (s, t).
// Source: OpenGL 4 Shading Language Cookbook, ch. 4, Using Alpha Maps to Discard Pixels.
// Range:  within 1e3.
// Edges:  none: interpolated as it is; textures repeat.

/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return textureCoordinate; }
