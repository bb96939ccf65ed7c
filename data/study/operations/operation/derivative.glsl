// Differences within a quad.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return dFdx(x) + operands.factor;
}
