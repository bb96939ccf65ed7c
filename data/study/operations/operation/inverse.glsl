// Inverse matrices.
#include "operands.glsl"

vec4 operate(vec4 x) {
    mat2 inverted = inverse(mat2(x));
    return vec4(inverted[0], inverted[1]);
}
