// The surface is not lit: its own colour passes through, whatever the lights (L1).
//
// Model:  K_d, tinted by the vertices' colour where there is one.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Introduction to Lighting: no lighting; glTF 2.0
//         KHR_materials_unlit.
// Range:  radiance 0 to 1.
// Edges:  none: no normal is asked for.
#include <material>
#include <vertex_color>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    chooseMaterial();
    return tinted(material.diffuse);
}
