// Depth moved towards the viewer by a uniform offset (D5).
//
// Model:  z + min(offset, 0), at least 0.
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs.
// Space:  window.
// Edges:  never greater than gl_FragCoord.z for any offset, a positive one or NaN counts as 0 (H-D1, H-D2).
#include "depth/offset.glsl"

DEPTH(depth_less) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float closer = depthOffset.offset < 0.0 ? depthOffset.offset : 0.0;  // H-D2
    gl_FragDepth = max(gl_FragCoord.z + closer, 0.0);                    // H-D1
}
