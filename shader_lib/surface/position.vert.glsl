// The surface's position in the vertex stage (E2, E4).
//
// Model:  p = M x with M affine.
// Spaces: attribute `position` in object space, result in eye space.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2.
// Edges:  none: finite for any finite matrix and position within the domain.
#include "surface/transform.vert.glsl"

ATTRIBUTE(0) vec3 position;

/// The vertex in eye space, once placeVertex() has been called.
vec3 placedPosition;

/// Transforms the vertex to eye space, once for all who ask. To be called first.
void placeVertex() { placedPosition = (transform.modelView * vec4(position, 1.0)).xyz; }

/// The position of the surface in eye space.
vec3 surfacePosition() { return placedPosition; }
