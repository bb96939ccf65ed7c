#version 450
// limiting cone angle: a spot light that shines everywhere, and a direction a rounding longer than 1.
layout(location = 0) in vec3 axis;
layout(location = 1) in vec3 ray;
uniform float cutoff;
layout(location = 0) out vec4 color;

void main() {
    float cosine = dot(axis, ray);
    color = vec4(cosine >= cos(cutoff) ? 1.0 : 0.0);  // wrong at axis = (0, 0, -1); ray = (0, 0, 1.000001); cutoff = 3.1415927: 0, not 1
}
