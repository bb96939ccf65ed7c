// The alpha of the vertices' colour is passed through to whoever blends (S17).
//
// Model:  alpha of C.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: FragColor = vec4(rgb, Color.a).
// Range:  0 to 1.
// Edges:  as surfaceColor().
#include "surface/color.glsl"

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return surfaceColor().a; }
