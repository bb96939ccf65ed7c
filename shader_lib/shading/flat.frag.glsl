// Flat shading (E1): the model is evaluated at each vertex, and a face shows the radiance of its provoking
// vertex, the last one unless the application chooses another. Fog is evaluated per fragment, as with shading
// per vertex.
//
// Model:  L of the provoking vertex, for the whole face.
// Source: Bouknight, A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics
//         Presentations, CACM 13 (1970).
// Range:  as litSurface().
// Edges:  none: nothing is interpolated.
#include <sides/flat_radiance>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return faceRadiance(); }
