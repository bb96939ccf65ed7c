// Arc cosines; the product keeps their argument within the domain.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return acos(x * operands.increment);
}
