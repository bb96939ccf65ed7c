// Minima and maxima: two of each, since one is soon done.
#include "operands.glsl"

vec4 operate(vec4 x) {
    x = min(x.yzwx, operands.factor);
    x = max(x.zwxy, operands.increment);
    x = min(x.yzwx, operands.factor.wxyz);
    return max(x.wxyz, operands.increment.yzwx);
}
