// Shading per vertex (E2): the model is evaluated at each vertex, its radiance interpolated. Fog is not part
// of it: it is evaluated per fragment, since it grows with a distance that no colour of a vertex knows.
//
// Model:  L interpolated between the vertices.
// Source: Gouraud, Continuous Shading of Curved Surfaces, IEEE Transactions on Computers 20 (1971).
// Range:  not negative.
// Edges:  interpolation may leave its range by a rounding; radiance is not negative (H-I1).
#include <sides/radiance>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return max(interpolatedRadiance(), vec3(0.0)); }  // H-I1
