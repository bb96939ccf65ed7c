#version 450
// no attenuation: all attenuation coefficients 0.
layout(location = 0) in float range;
uniform vec3 coefficients;
layout(location = 0) out vec4 color;

void main() {
    vec3 k = abs(coefficients);
    float d = abs(range);
    color = vec4(1.0 / (k.x + d * (k.y + d * k.z)));  // trap: division by zero
}
