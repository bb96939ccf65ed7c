// The direction to the viewer, in eye space.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Local Viewer, Directional Light.

#piece local
// Who stands at the origin: -p / |p|, zero at the viewer itself.
#include <guards/unit_vector>
#include "surface/position.glsl"

/// The unit vector from the surface to the viewer, in eye space.
vec3 towardViewer() { return unitVector(-surfacePosition()); }

#piece infinite
// Infinitely far away, the same everywhere: cheaper, and the further the surface is from the middle of the picture, the
// further highlights are from where a camera sees them.
/// The unit vector from the surface to the viewer, in eye space.
vec3 towardViewer() { return vec3(0.0, 0.0, 1.0); }
