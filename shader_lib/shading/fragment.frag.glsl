// Shading per fragment (E4): position and normal are interpolated, the model is evaluated at each fragment.
//
// Model:  L at each fragment.
// Source: Phong, Illumination for Computer Generated Pictures, CACM 18 (1975).
// Range:  as litSurface().
// Edges:  as surfaceNormal(): interpolated normals may cancel each other (H-N1).
#include <lighting>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return litSurface(); }
