// Holes in the surface, cut by alpha.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Discarding Fragments to Create a Perforated Look, ch. 3, Using
//         Alpha Maps to Discard Pixels; glTF 2.0, alphaMode MASK, for the side of the threshold.

#piece none
/// Discards the fragment where the surface has a hole: nowhere.
void cutOut() {}

#piece threshold
// Discard where alpha of the map times alpha of the vertices < threshold, all 0 to 1. Exactly at the threshold the surface
// stays; a threshold of 0 cuts nothing.
#include <vertex_color/alpha>
#include "cutout/parameters.glsl"
#include "surface/texture_coordinate.glsl"

/// How opaque the surface is, in alpha.
SAMPLER(0, sampler2D) opacityMap;

/// Discards the fragment where the surface has a hole.
void cutOut() {
    if (texture(opacityMap, surfaceTextureCoordinate()).a * surfaceAlpha() < cutout.threshold) discard;
}

#piece parameters
/// What is less opaque is cut.
BLOCK(15, Cutout) {
    float threshold;
} cutout;
