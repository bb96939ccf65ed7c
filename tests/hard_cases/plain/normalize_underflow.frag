#version 450
// tiny vector: a direction between points that are very near each other.
layout(location = 0) in vec3 position;
layout(location = 0) out vec4 color;

void main() {
    vec3 offset = position * 1e-25;
    if (offset == vec3(0.0)) discard;
    vec3 direction = normalize(offset);  // trap: normalize() underflows: the square of the length is too small
    color = vec4(direction, 1.0);
}
