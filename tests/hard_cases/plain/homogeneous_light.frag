#version 450
// light at the surface, lights by the w convention: a light that is local by its w, and is not.
layout(location = 0) in vec3 position;
uniform vec4 light;
layout(location = 0) out vec4 color;

void main() {
    vec3 ray = light.xyz / light.w - position;  // trap: division by zero
    color = vec4(ray, 1.0);
}
