// The depth of the surface itself, tested whenever the driver likes (D1).
//
// Model:  z as it comes from rasterisation.
// Source: OpenGL Shading Language 4.50, 7.1.5: gl_FragDepth that no path writes is gl_FragCoord.z.
// Range:  0 to 1, in window space.
// Edges:  none: nothing is written.

/// Writes the fragment's depth: left to the driver.
void writeDepth() {}
