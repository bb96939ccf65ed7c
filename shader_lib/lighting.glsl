// Whether the surface is lit, and its ambient light.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7; glTF 2.0 KHR_materials_unlit.

#piece lit
// The whole lighting model.
#include "lighting/radiance.glsl"

#piece unlit
// The diffuse colour itself, tinted by the vertices' colour where there is one.
#include <material>
#include <vertex_color>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    chooseMaterial();
    return tinted(material.diffuse);
}

#piece ambient
// K_a A; reaches a surface without a normal, too.
#include <ambient>
#include <material>
#include <vertex_color>

/// The ambient light that the surface reflects.
vec3 ambientRadiance() { return tinted(material.ambient) * ambientLight(); }
