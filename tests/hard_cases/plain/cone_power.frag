#version 450
// behind a wide cone: behind a spot light, inside a cone wider than 180 degrees.
layout(location = 0) in vec3 axis;
layout(location = 1) in vec3 ray;
uniform float exponent;
layout(location = 0) out vec4 color;

void main() {
    float cosine = clamp(dot(axis, ray), -1.0, 1.0);
    if (cosine == 0.0) discard;
    color = vec4(pow(cosine, clamp(exponent, 0.0, 9.0)));  // trap: pow() of a negative number
}
