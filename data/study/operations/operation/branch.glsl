// A branch that fragments take either way.
#include "operands.glsl"

vec4 operate(vec4 x) {
    if (x.x > operands.factor.x)
        x = x.yzwx;
    return x + operands.increment;
}
