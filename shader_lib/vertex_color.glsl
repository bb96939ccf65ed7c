// The colour of the vertices: it tints diffuse and ambient light, highlights keep theirs; its alpha is written
// for blending.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7: Color.rgb * scatteredLight + reflectedLight, Color.a.

#piece none
/// The reflectivity of ambient and diffuse light.
vec3 tinted(vec3 reflectivity) { return reflectivity; }

#piece alpha/none
/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return 1.0; }

#piece modulate
#include "surface/color.glsl"

/// The reflectivity of ambient and diffuse light.
vec3 tinted(vec3 reflectivity) { return surfaceColor().rgb * reflectivity; }

#piece alpha/modulate
#include "surface/color.glsl"

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return surfaceColor().a; }
