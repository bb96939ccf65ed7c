// Where on its textures the surface lies, in the fragment stage: interpolated (S16).

/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return textureCoordinate; }
