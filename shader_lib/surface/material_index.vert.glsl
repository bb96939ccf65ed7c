// Which material the surface is made of, in the vertex stage (S10).

ATTRIBUTE(3) int materialIndex;

/// The surface's index into a table of materials.
int surfaceMaterialIndex() { return materialIndex; }
