// The direction to a local viewer, who stands at the origin of eye space (S6).
//
// Model:  v = -p / |p|.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Local Viewer.
// Space:  eye. Range: as unitVector().
// Edges:  zero at the viewer itself (H-N1), where highlights fade as for a viewer at a right angle.
#include <guards/unit_vector>
#include "surface/position.glsl"

/// The unit vector from the surface to the viewer, in eye space.
vec3 towardViewer() { return unitVector(-surfacePosition()); }
