#version 450
// H-L1: a light at the surface point.
layout(location = 0) in vec3 position;
uniform vec3 lightPosition;
layout(location = 0) out vec4 color;

void main() {
    vec3 ray = lightPosition - position;
    color = vec4(1.0 / dot(ray, ray));  // trap: division by zero
}
