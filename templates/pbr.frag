// The fragment stage of physically based surfaces: radiance, seen through the fog, alpha and depth.
#include <cutout/physical>
#include <output_range>
#include <lighting>
#include <fog>
#include <depth>
#include "pbr/base_color.glsl"

/// Linear radiance, within what the target holds; how opaque.
OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = vec4(withinRange(throughFog(litSurface())), baseColor().a);
    writeDepth();
    cutOut();  // last, so that derivatives are defined up to here
}
