// What the surface is made of.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Material Properties.
// Ranges: reflectivities 0 to 1, emission 0 to 1e5 (radiance), shininess 0 to 1e6, strength 0 to 1e3.

#piece uniform
// One material for the whole draw.
/// What the surface emits and how much it reflects, per colour channel. `strength` scales the highlight.
BLOCK(1, Material) {
    vec3 emission;
    float shininess;
    vec3 ambient;
    float strength;
    vec3 diffuse;
    vec3 specular;
} material;

/// Makes `material` that of the surface point: it always is. To be called first.
void chooseMaterial() {}

#piece array
// A table of materials, and for each vertex an index into it; an index beyond the table takes the nearest row.
#include <sides/material>
#include "surface/material_index.glsl"

/// What a surface emits and how much it reflects, per colour channel. `strength` scales the highlight.
struct MaterialRow {
    vec3 emission;
    float shininess;
    vec3 ambient;
    float strength;
    vec3 diffuse;
    vec3 specular;
};

/// The table.
BLOCK(12, Materials) {
    MaterialRow rows[14];
} materials;

/// The material of the surface point, once chooseMaterial() has been called.
MaterialRow material;

/// Makes `material` that of the surface point. To be called first.
void chooseMaterial() { material = materials.rows[materialRow(surfaceMaterialIndex(), 14)]; }
