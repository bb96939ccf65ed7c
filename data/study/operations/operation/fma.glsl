// Multiplications with additions: four, since one is soon done.
#include "operands.glsl"

vec4 operate(vec4 x) {
    x = fma(x, operands.factor, operands.increment);
    x = fma(x, operands.factor.yzwx, operands.increment.yzwx);
    x = fma(x, operands.factor.zwxy, operands.increment.zwxy);
    return fma(x, operands.factor.wxyz, operands.increment.wxyz);
}
