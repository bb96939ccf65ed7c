// Hybrid shading (E3): what changes slowly over a surface (the direction to each light, how much of it
// arrives, the half vector) is evaluated at each vertex and interpolated; dot products and powers, which do
// not, are evaluated at each fragment.
//
// Model:  L at each fragment, of s, h and shares from the vertices.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Range:  as litSurface().
// Edges:  interpolated directions are made unit again where the key has normals made so.
#include <lighting>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return litSurface(); }
