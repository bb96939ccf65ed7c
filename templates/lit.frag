// The fragment stage of every lit surface: its radiance, seen through the fog, its alpha and its depth.
#include <cutout>
#include <vertex_color/alpha>
#include <shading>
#include <fog>
#include <depth>

/// Linear radiance, unclamped; how opaque.
OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = vec4(throughFog(surfaceRadiance()), surfaceAlpha());
    writeDepth();
    cutOut();  // last, so that derivatives are defined up to here
}
