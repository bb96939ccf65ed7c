// Where on its textures the surface lies, in the vertex stage (S16).

ATTRIBUTE(4) vec2 texcoord;

/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return texcoord; }
