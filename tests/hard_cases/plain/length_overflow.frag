#version 450
// fog very far away, huge vector: radial fog of something very far away.
layout(location = 0) in vec3 position;
layout(location = 0) out vec4 color;

void main() {
    vec3 far = position * 1e20;
    float distance = length(far);  // trap: length() overflows: its square is too large
    color = vec4(exp(-distance));
}
