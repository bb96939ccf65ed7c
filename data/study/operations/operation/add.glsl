// Additions: four, since one is soon done.
#include "operands.glsl"

vec4 operate(vec4 x) {
    x = x + operands.increment;
    x = x + operands.factor;
    x = x + operands.increment.yzwx;
    return x + operands.factor.zwxy;
}
