// The fragment stage of every lit surface: its radiance, seen through the fog, its alpha and its depth.
#include <cutout>
#include <depth>
#include <fog>
#include <shading>
#include <vertex_color/alpha>

/// Linear radiance, unclamped; how opaque.
OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = vec4(throughFog(surfaceRadiance()), surfaceAlpha());
    writeDepth();
    cutOut();  // last, so that derivatives are defined up to here
}
