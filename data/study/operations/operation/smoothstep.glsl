// Smooth steps.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return smoothstep(operands.increment, operands.factor, x);
}
