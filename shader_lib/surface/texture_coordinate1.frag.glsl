// The second texture coordinates, at the fragment. Source: glTF 2.0, 3.7.2.1.
/// The second texture coordinates.
vec2 surfaceTextureCoordinate1() { return textureCoordinate1; }
