// One material for both sides, from a table (S10, S11).
#include "sides/material/one.glsl"
