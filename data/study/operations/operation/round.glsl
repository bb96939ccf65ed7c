// Roundings; the sum keeps them from being idle.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return floor(x) + operands.increment;
}
