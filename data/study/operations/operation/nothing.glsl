// Nothing but the call itself.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return x;
}
