// Texture lookups.
#include "operands.glsl"

SAMPLER(0, sampler2D) checker;

vec4 operate(vec4 x) {
    return texture(checker, x.xy) + operands.increment;
}
