#version 450
// interpolated out of range: the share of a sky by a normal that interpolation left longer than 1.
layout(location = 0) in vec3 normal;
uniform vec3 up;
layout(location = 0) out vec4 color;

void main() {
    float share = 0.5 + 0.5 * dot(normal, up);
    color = vec4(share);  // wrong at normal = (0, 0, 1.000001); up = (0, 0, -1): -4.76837e-07, not 0
}
