// The colour of the surface: that of metal's reflection, and of what a dielectric scatters. The vertices' colour and a picture tint it.
//
// Source: glTF 2.0, 3.9.2.

#include <base_color_map>
#include <vertex_color>
#include <vertex_color/alpha>
#include "pbr/material.glsl"

/// The base colour, linear, and how opaque it is.
vec4 baseColor() {
    vec4 color = material.baseColor * baseColorTexel();
    return vec4(tinted(color.rgb), color.a * surfaceAlpha());
}
