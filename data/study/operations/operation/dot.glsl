// Dot products.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.yzw, dot(x, operands.factor));
}
