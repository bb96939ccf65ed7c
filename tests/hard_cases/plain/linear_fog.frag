#version 450
// fog that is a step: linear fog whose near is its far.
layout(location = 0) in vec3 position;
uniform float near;
uniform float far;
layout(location = 0) out vec4 color;

void main() {
    float fogFactor = (far - abs(position.z)) / (far - near);  // trap: division by zero
    color = vec4(clamp(fogFactor, 0.0, 1.0));  // so: clamp() fed a NaN
}
