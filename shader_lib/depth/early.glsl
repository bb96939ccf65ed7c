// The depth of the surface itself, tested before the fragment is shaded (D2).
//
// Model:  z as it comes from rasterisation.
// Source: OpenGL Shading Language 4.50, 4.4.1.3: what a shader then writes to gl_FragDepth is ignored.
// Range:  0 to 1, in window space.
// Edges:  nothing may be discarded or written after the test: the rules of `lit` forbid the cutout with it.
DEPTH(early_fragment_tests) in;

/// Writes the fragment's depth: left to the driver.
void writeDepth() {}
