// The colour of the vertices tints scattered light, where a switch has it so (L8, S17).
//
// Model:  C K, or K.
// Source, ranges: as the tint's.
// Edges:  as surfaceColor(): never negative (H-I1).
#include "uber/switches.glsl"
#include "vertex_color/modulate.glsl" with tinted as tintedByVertices
#include "vertex_color/none.glsl" with tinted as untinted

/// The reflectivity that scatters light.
vec3 tinted(vec3 reflectivity) {
    return switches.vertex_color == 1 ? tintedByVertices(reflectivity) : untinted(reflectivity);
}
