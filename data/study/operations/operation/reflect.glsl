// Mirrored vectors.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.w, reflect(x.xyz, operands.factor.xyz));
}
