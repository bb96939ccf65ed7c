// The fragment stage of every lit surface: its radiance, seen through the fog, and its depth.
#include <shading>
#include <fog>
#include <depth>

/// Linear radiance, unclamped; opaque.
OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = vec4(throughFog(surfaceRadiance()), 1.0);
    writeDepth();
}
