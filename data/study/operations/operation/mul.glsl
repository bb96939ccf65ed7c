// Multiplications.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return x * operands.factor;
}
