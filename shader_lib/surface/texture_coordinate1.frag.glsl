// The second texture coordinates, at the fragment.
/// The second texture coordinates.
vec2 surfaceTextureCoordinate1() { return textureCoordinate1; }
