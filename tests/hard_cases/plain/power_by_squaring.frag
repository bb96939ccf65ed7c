#version 450
// power of a negative base: a power by squaring (1 - m v / n)^n: below its last root the highlight comes back.
layout(location = 0) in float oneMinusCosine;
uniform float shininess;
layout(location = 0) out vec4 color;

void main() {
    float base = 1.0 - clamp(shininess, 0.0, 128.0) * clamp(oneMinusCosine, 0.0, 2.0) / 16.0;
    base *= base;
    base *= base;
    base *= base;
    color = vec4(base * base);  // wrong at oneMinusCosine = 0.5; shininess = 80: 656.841, not 0
}
