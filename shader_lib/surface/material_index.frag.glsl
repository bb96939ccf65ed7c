// Which material the surface is made of, in the fragment stage: the triangle's provoking vertex says (S10).
//
// Model:  i.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Material Properties: an array of materials.
// Range:  any integer.
// Edges:  materialRow() tells what an index beyond the table means.

/// The surface's index into a table of materials.
int surfaceMaterialIndex() { return flatMaterialIndex; }
