// Divisions.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return operands.factor / x;
}
