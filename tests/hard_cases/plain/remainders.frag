#version 450
// Stripes whose number comes from outside.
layout(location = 0) in float x;
uniform float period;
uniform int stripes;
layout(location = 0) out vec4 color;

void main() {
    float phase = mod(x, period);  // trap: mod() by zero
    int stripe = int(x) / stripes;  // trap: integer division by zero
    color = vec4(phase, float(stripe), 0.0, 1.0);
}
