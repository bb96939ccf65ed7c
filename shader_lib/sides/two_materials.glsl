// Two sides with a material each (S11): normals as with one material; the material is sides/material's part.
#include "sides/two.glsl"
