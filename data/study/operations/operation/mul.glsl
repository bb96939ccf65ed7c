// Multiplications: four, since one is soon done.
#include "operands.glsl"

vec4 operate(vec4 x) {
    x = x * operands.factor;
    x = x * operands.factor.yzwx;
    x = x * operands.factor.zwxy;
    return x * operands.factor.wxyz;
}
