// Whole numbers.
#include "operands.glsl"

vec4 operate(vec4 x) {
    return intBitsToFloat((floatBitsToInt(x) ^ operands.bits) + operands.bits.yzwx);
}
