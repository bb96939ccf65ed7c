// The thresholds and tones of cartoon shading, where the law is chosen at run time (S8, L8).
#include "uber/toon.glsl"
