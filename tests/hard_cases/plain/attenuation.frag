#version 450
// light at the surface: attenuation by the square of its distance.
layout(location = 0) in vec3 position;
uniform vec3 lightPosition;
layout(location = 0) out vec4 color;

void main() {
    vec3 ray = lightPosition - position;
    color = vec4(1.0 / dot(ray, ray));  // trap: division by zero
}
