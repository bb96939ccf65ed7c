// Depth moved away from the viewer by a uniform offset (D4).
//
// Model:  z + max(offset, 0), at most 1.
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs.
// Space:  window.
// Edges:  never less than gl_FragCoord.z for any offset, a negative one or NaN counts as 0 (H-D1, H-D2).
#include "depth/offset.glsl"

DEPTH(depth_greater) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float away = depthOffset.offset > 0.0 ? depthOffset.offset : 0.0;  // H-D2
    gl_FragDepth = min(gl_FragCoord.z + away, 1.0);                    // H-D1
}
