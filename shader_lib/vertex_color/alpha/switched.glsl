// The alpha of the vertices' colour is passed through, where a switch has it so (L8, S17).
//
// Model:  alpha of C, or 1.
// Source: OpenGL Programming Guide, 9th ed., ch. 7.
// Range:  0 to 1.
// Edges:  as surfaceColor().
#include "uber/switches.glsl"
#include "vertex_color/alpha/modulate.glsl" with surfaceAlpha as alphaOfVertices
#include "vertex_color/alpha/none.glsl" with surfaceAlpha as opaque

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return switches.vertex_color == 1 ? alphaOfVertices() : opaque(); }
