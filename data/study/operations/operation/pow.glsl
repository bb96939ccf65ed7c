// Powers.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return pow(x, operands.factor);
}
