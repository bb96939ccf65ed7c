// Fused multiply-adds.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return fma(x, operands.factor, operands.increment);
}
