// The second texture coordinates, at the vertex. Source: glTF 2.0, 3.7.2.1.
ATTRIBUTE(5) vec2 texcoord1;

/// The second texture coordinates.
vec2 surfaceTextureCoordinate1() { return texcoord1; }
