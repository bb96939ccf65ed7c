// Holes in a surface, cut by the alpha of its base colour. Source: glTF 2.0, 3.9.4, alphaMode MASK.

#piece none
/// Discards the fragment where the surface has a hole: nowhere.
void cutOut() {}

#piece threshold
// Discard where alpha < threshold; exactly at the threshold the surface stays.
#include "cutout/parameters.glsl"
#include "pbr/base_color.glsl"

/// Discards the fragment where the surface has a hole.
void cutOut() {
    if (baseColor().a < cutout.threshold) discard;
}
