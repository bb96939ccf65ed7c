// The depth of the surface itself, written by the shader (D6).
//
// Model:  z.
// Source: OpenGL Shading Language 4.50, 4.4.2.1, Fragment Shader Outputs.
// Space:  window.
// Edges:  exactly gl_FragCoord.z, so the promise holds (H-D2).
DEPTH(depth_unchanged) out float gl_FragDepth;

/// Writes the fragment's depth.
void writeDepth() { gl_FragDepth = gl_FragCoord.z; }
