// The second texture coordinates, at the vertex.
ATTRIBUTE(5) vec2 texcoord1;

/// The second texture coordinates.
vec2 surfaceTextureCoordinate1() { return texcoord1; }
