// The depth of the surface itself, tested before the fragment is shaded (D2).
//
// Source: OpenGL Shading Language 4.50, 4.4.1.3: what a shader then writes to gl_FragDepth is ignored.
DEPTH(early_fragment_tests) in;

/// Writes the fragment's depth: left to the driver.
void writeDepth() {}
