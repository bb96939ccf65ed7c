// Shading per fragment (E4): position and normal are interpolated, the model is evaluated at each fragment.
//
// Source: Phong, Illumination for Computer Generated Pictures, CACM 18 (1975).
#include <lighting>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return litSurface(); }
