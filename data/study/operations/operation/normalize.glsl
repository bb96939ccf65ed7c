// Unit vectors.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.w, normalize(x.xyz));
}
