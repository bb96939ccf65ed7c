// Lengths.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.yzw, length(x.xyz));
}
