// The number of tones of cartoon shading in bands, where the law is chosen at run time (S7, L8).
#include "uber/toon.glsl"
