// Products of a matrix and a vector, which are counted as what they consist of.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return operands.turn * x;
}
