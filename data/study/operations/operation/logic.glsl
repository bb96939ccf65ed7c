// Comparisons joined to one choice.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return all(lessThan(x, operands.factor)) || any(greaterThan(x, operands.increment)) ? x.yzwx : operands.factor;
}
