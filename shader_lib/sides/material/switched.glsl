// One material for both sides, or one for each, as a switch has it (L8, S10, S11).
//
// Model:  that of the chosen sides.
// Source, edges: as the sides'.
// Range:  as the sides'.
#include "sides/material/one.glsl" with materialRow as rowOfBothSides
#include "sides/material/two_materials.glsl" with materialRow as rowOfSide
#include "uber/switches.glsl"

/// The row of a table of so many materials, for a surface's index.
int materialRow(int index, int rows) {
    return switches.sides == 2 ? rowOfSide(index, rows) : rowOfBothSides(index, rows);
}
