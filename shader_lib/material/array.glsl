// A table of materials, and for each vertex an index into it (S10).
//
// Model:  the material of row i, or for two materials of row 2 i in front and 2 i + 1 at the back (S11).
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Material Properties: an array of 14 materials; its
//         per-vertex index, flat.
// Ranges: as one material's; the index is any.
// Edges:  an index beyond the table takes the nearest row.
#include <sides/material>
#include "surface/material_index.glsl"

/// What a surface emits and how much it reflects, per colour channel. `strength` scales the highlight (S5).
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
