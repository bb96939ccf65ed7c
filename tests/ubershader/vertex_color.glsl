// The vertices' colours, where a switch has it so.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_modulate
#define tinted tintedByVertices

#piece as_none
#undef tinted
#define tinted untinted

#piece as_itself
#undef tinted

#piece alpha/as_modulate
#define surfaceAlpha alphaOfVertices

#piece alpha/as_none
#undef surfaceAlpha
#define surfaceAlpha opaque

#piece alpha/as_itself
#undef surfaceAlpha

#piece switched
#include "uber/switches.glsl"
#include "vertex_color/as_modulate.glsl"
#include "vertex_color/modulate.glsl"
#include "vertex_color/as_none.glsl"
#include "vertex_color/none.glsl"
#include "vertex_color/as_itself.glsl"

/// The reflectivity of ambient and diffuse light.
vec3 tinted(vec3 reflectivity) {
    return switches.vertex_color == 1 ? tintedByVertices(reflectivity) : untinted(reflectivity);
}

#piece alpha/switched
#include "uber/switches.glsl"
#include "vertex_color/alpha/as_modulate.glsl"
#include "vertex_color/alpha/modulate.glsl"
#include "vertex_color/alpha/as_none.glsl"
#include "vertex_color/alpha/none.glsl"
#include "vertex_color/alpha/as_itself.glsl"

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return switches.vertex_color == 1 ? alphaOfVertices() : opaque(); }
