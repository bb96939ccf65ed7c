#version 450
// A sum that nobody set to zero.
layout(location = 0) in vec3 light;
layout(location = 0) out vec4 color;

void main() {
    vec3 total;
    for (int i = 0; i < 3; ++i) total += light;  // trap: a value is read before it is written
    color = vec4(total, 1.0);
}
