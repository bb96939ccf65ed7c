// The ambient light that a switch chooses at run time; an unknown number is light from everywhere alike.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_global
#define ambientLight globalLight

#piece as_hemisphere
#undef ambientLight
#define ambientLight hemisphereLight

#piece as_image
#undef ambientLight
#define ambientLight lightOfImage

#piece as_spherical_harmonics
#undef ambientLight
#define ambientLight lightOfHarmonics

#piece as_itself
#undef ambientLight

#piece switched
#include "ambient/as_global.glsl"
#include "ambient/global.glsl"
#include "ambient/as_hemisphere.glsl"
#include "ambient/hemisphere.glsl"
#include "ambient/as_image.glsl"
#include "ambient/image.glsl"
#include "ambient/as_spherical_harmonics.glsl"
#include "ambient/spherical_harmonics.glsl"
#include "ambient/as_itself.glsl"
#include "uber/switches.glsl"

/// The ambient light that arrives at the surface.
vec3 ambientLight() {
    if (switches.ambient == 1) return hemisphereLight();
    if (switches.ambient == 2) return lightOfHarmonics();
    if (switches.ambient == 3) return lightOfImage();
    return globalLight();
}
