// A comparison and a choice for each component.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return mix(x.yzwx, operands.increment, lessThan(x, operands.factor));
}
