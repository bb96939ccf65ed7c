// Cross products.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return vec4(x.w, cross(x.xyz, operands.factor.xyz));
}
