// The normal of a clear coat, which lies smoothly over what a picture bends. Source: KHR_materials_clearcoat.

#piece none
#include "pbr/surface.glsl"

/// The unit normal of the coat on the side that is seen; zero where there is none.
vec3 coatDirection() { return surface.normal; }

#piece tangent
#include <normal>
#include <sides/cosine>

/// The unit normal of the coat on the side that is seen; zero where there is none.
vec3 coatDirection() { return cosineOfSide(1.0) * shadingDirection(eyeNormal); }

#piece derivatives
#include "normal_map/coat/tangent.glsl"
