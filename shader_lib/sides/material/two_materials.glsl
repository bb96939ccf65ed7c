// A material for each side, from a table of pairs (S10, S11).
//
// Model:  the front's row is 2 i, the back's 2 i + 1.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Two-sided Lighting; there odd indices may not be passed
//         in, here every index is that of a pair.
// Range:  any index, 2 rows or more; result 0 to rows - 1.
// Edges:  an index beyond the table takes the nearest of its pairs, never memory beside it.
#include "surface/side.glsl"

/// The row of a table of so many materials (an even number), for a surface's index.
int materialRow(int index, int rows) {
    int front = 2 * clamp(index, 0, rows / 2 - 1);
    return isBackVisible() ? front + 1 : front;
}
