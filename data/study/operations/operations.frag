// The same operation a few times or many: the difference is its price.
#include <repeats>

OUTPUT(0) vec4 fragmentColor;

void main() {
    fragmentColor = repeated(vec4(1.0) + operands.increment * fract(surface).xyzx);
}
