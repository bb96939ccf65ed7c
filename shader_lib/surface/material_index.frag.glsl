// Which material the surface is made of, in the fragment stage: the triangle's provoking vertex says (S10).

/// The surface's index into a table of materials.
int surfaceMaterialIndex() { return flatMaterialIndex; }
