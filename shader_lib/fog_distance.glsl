// The distance through fog to the surface, in eye space.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.

#piece radial
// By the distance to the viewer: the same fog wherever the viewer looks.
#include <guards/vector_length>
#include "surface/position.glsl"

/// The distance through fog to the surface; not negative.
float fogDistance() { return vectorLength(surfacePosition()); }

#piece planar
// By the depth in front of the viewer: cheaper, but the fog thins towards the picture's corners.
#include "surface/position.glsl"

/// The distance through fog to the surface; not negative.
float fogDistance() { return abs(surfacePosition().z); }
