// The colour of the surface: that of metal's reflection, and of what a dielectric scatters. The vertices' colour tints it.
//
// Source: glTF 2.0, 3.9.2.

#include <vertex_color>
#include <vertex_color/alpha>
#include "pbr/material.glsl"

/// The base colour, linear, and how opaque it is.
vec4 baseColor() { return vec4(tinted(material.baseColor.rgb), material.baseColor.a * surfaceAlpha()); }
