#version 450
// zero vector: the normal as it was interpolated.
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 color;

void main() {
    vec3 n = normalize(normal);  // trap: normalize() of a zero vector
    color = vec4(0.5 * n + 0.5, 1.0);
}
