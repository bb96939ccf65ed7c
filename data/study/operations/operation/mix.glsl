// Mixtures.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return mix(x, operands.factor, operands.increment);
}
