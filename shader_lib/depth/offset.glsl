// The offset that moves a surface's depth: for decals and for bias.
//
// Space:  window. Range: -1 to 1; window depth itself is 0 to 1.

/// How far to move the surface's depth; away from the viewer where positive.
BLOCK(8, DepthOffset) {
    float offset;
} depthOffset;
