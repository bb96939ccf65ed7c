// The depth that is written, in window space. Whatever the offset, NaN included, it keeps to [0, 1] and to what its
// qualifier promises.
//
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs; 7.1.5 and 4.4.1.3 for depths not written.

#piece default
// Not written: the driver tests the depth of rasterisation whenever it likes.
/// Writes the fragment's depth: left to the driver.
void writeDepth() {}

#piece early
// That of rasterisation, tested before the fragment is shaded: lit.toml forbids the cutout with it.
DEPTH(early_fragment_tests) in;

/// Writes the fragment's depth: left to the driver.
void writeDepth() {}

#piece unchanged
// That of rasterisation, written by the shader.
DEPTH(depth_unchanged) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() { gl_FragDepth = gl_FragCoord.z; }

#piece any
// Moved to either side: z + offset. NaN gives 0.
#include "depth/offset.glsl"

DEPTH(depth_any) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float moved = gl_FragCoord.z + depthOffset.offset;
    gl_FragDepth = moved > 0.0 ? min(moved, 1.0) : 0.0;  // guard: depth outside 0 to 1
}

#piece greater
// Moved away from the viewer: z + max(offset, 0), NaN counting as 0.
#include "depth/offset.glsl"

DEPTH(depth_greater) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float away = depthOffset.offset > 0.0 ? depthOffset.offset : 0.0;  // guard: promised side
    gl_FragDepth = min(gl_FragCoord.z + away, 1.0);                    // guard: depth outside 0 to 1
}

#piece less
// Moved towards the viewer: z + min(offset, 0), NaN counting as 0.
#include "depth/offset.glsl"

DEPTH(depth_less) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() {
    float closer = depthOffset.offset < 0.0 ? depthOffset.offset : 0.0;  // guard: promised side
    gl_FragDepth = max(gl_FragCoord.z + closer, 0.0);                    // guard: depth outside 0 to 1
}

#piece offset
/// How far to move the surface's depth; away from the viewer where positive.
BLOCK(8, DepthOffset) {
    float offset;
} depthOffset;
