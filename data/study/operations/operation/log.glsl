// Logarithms; the sum keeps their argument above 1.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return log(x + operands.factor + operands.factor);
}
