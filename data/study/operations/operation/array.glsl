// Writing and reading a local variable.
#include "operands.glsl"

vec4 operate(vec4 x) {
    vec4 kept[2];
    kept[0] = x;
    kept[1] = operands.factor;
    return kept[0].yzwx;
}
