// Taking apart and putting together.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.w, x.z, x.x, x.y);
}
