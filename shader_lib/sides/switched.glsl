// One side or two, as a switch has it (L8, S11).
//
// Model:  that of the chosen sides.
// Source, space, edges: as the sides'.
#include "sides/one.glsl" with visibleNormal as normalOfFront
#include "sides/two.glsl" with visibleNormal as normalOfSide
#include "uber/switches.glsl"

/// The unit normal that light is weighed against; zero where there is none.
vec3 visibleNormal() { return switches.sides == 0 ? normalOfFront() : normalOfSide(); }
