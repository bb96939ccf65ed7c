// One material for both sides, from a table (S10).
//
// Model:  i.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Material Properties: an array of materials.
// Range:  any index; result 0 to rows - 1.
// Edges:  an index beyond the table takes the nearest of its rows, never memory beside it.

/// The row of a table of so many materials, for a surface's index.
int materialRow(int index, int rows) { return clamp(index, 0, rows - 1); }
