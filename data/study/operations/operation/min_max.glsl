// Minima and maxima.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return max(min(x, operands.factor), operands.increment.wzyx);
}
