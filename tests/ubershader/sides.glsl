// One side or two, with a material for each or for both, as a switch has it.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_one
#define visibleNormal normalOfFront

#piece as_two
#undef visibleNormal
#define visibleNormal normalOfSide

#piece as_itself
#undef visibleNormal

#piece material/as_one
#define materialRow rowOfBothSides

#piece material/as_two_materials
#undef materialRow
#define materialRow rowOfSide

#piece material/as_itself
#undef materialRow

#piece switched
#include "sides/as_one.glsl"
#include "sides/one.glsl"
#include "sides/as_two.glsl"
#include "sides/two.glsl"
#include "sides/as_itself.glsl"
#include "uber/switches.glsl"

/// The unit normal that light is weighed against; zero where there is none.
vec3 visibleNormal() { return switches.sides == 0 ? normalOfFront() : normalOfSide(); }

#piece material/switched
#include "sides/material/as_one.glsl"
#include "sides/material/one.glsl"
#include "sides/material/as_two_materials.glsl"
#include "sides/material/two_materials.glsl"
#include "sides/material/as_itself.glsl"
#include "uber/switches.glsl"

/// The row of a table of so many materials, for a surface's index.
int materialRow(int index, int rows) {
    return switches.sides == 2 ? rowOfSide(index, rows) : rowOfBothSides(index, rows);
}
