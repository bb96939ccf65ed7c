// Depth moved by a uniform offset to either side (D3).
//
// Model:  z + offset, clamped to [0, 1].
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs.
// Space:  window.
// Edges:  written on every path and in [0, 1] for any offset; NaN gives 0 (H-D1).
#include "depth/offset.glsl"

DEPTH(depth_any) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float moved = gl_FragCoord.z + depthOffset.offset;
    gl_FragDepth = moved > 0.0 ? min(moved, 1.0) : 0.0;  // H-D1
}
