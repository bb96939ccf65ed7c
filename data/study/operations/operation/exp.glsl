// Exponentials.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return exp(operands.increment - x);
}
