// A cosine to the front's normal, as a switch has one side or two (L8, S11).
#include "sides/cosine.glsl" with cosineOfSide as cosineOfVisibleSide
#include "uber/switches.glsl"

/// The cosine to the normal that light is weighed against.
float cosineOfSide(float cosine) { return switches.sides == 0 ? cosine : cosineOfVisibleSide(cosine); }
