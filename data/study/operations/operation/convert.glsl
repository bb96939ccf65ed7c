// Conversions to whole numbers and back.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(ivec4(x)) + operands.increment;
}
