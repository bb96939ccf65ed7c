// The offset that moves a surface's depth: for decals and for bias (D3, D4, D5).
//
// Model:  the o of z + o.
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs.
// Space:  window. Range: -1 to 1; window depth itself is 0 to 1.
// Edges:  the pieces that read it clamp what comes out of [0, 1].

/// How far to move the surface's depth; away from the viewer where positive.
BLOCK(8, DepthOffset) {
    float offset;
} depthOffset;
