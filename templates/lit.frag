// The fragment stage of every lit surface: its radiance, seen through the fog, its alpha and its depth.
#include <cutout>
#include <vertex_color/alpha>
#include <output_range>
#include <shading>
#include <fog>
#include <depth>

/// Linear radiance, within what the target holds; how opaque.
OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = vec4(withinRange(throughFog(surfaceRadiance())), surfaceAlpha());
    writeDepth();
    cutOut();  // last, so that derivatives are defined up to here
}
