// Holes cut by alpha (S16): what is less opaque than a threshold is not there.
//
// Model:  discard where a C_a < threshold, with a the alpha of a map and C_a that of the vertices' colour.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Discarding Fragments to Create a Perforated Look, ch. 3,
//         Using Alpha Maps to Discard Pixels; glTF 2.0, alphaMode MASK, for the side of the threshold.
// Ranges: alphas and threshold 0 to 1.
// Edges:  alpha exactly at the threshold stays; a threshold of 0 cuts nothing.
#include <vertex_color/alpha>
#include "surface/texture_coordinate.glsl"

/// What is less opaque is cut.
BLOCK(15, Cutout) {
    float threshold;
} cutout;

/// How opaque the surface is, in alpha.
SAMPLER(0, sampler2D) opacityMap;

/// Discards the fragment where the surface has a hole.
void cutOut() {
    if (texture(opacityMap, surfaceTextureCoordinate()).a * surfaceAlpha() < cutout.threshold) discard;
}
