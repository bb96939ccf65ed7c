#version 450
// Varyings interpolated in each of the ways that GLSL knows.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(std140, binding = 0) uniform Transform { mat4 modelView; mat4 projection; };
layout(location = 0) out vec3 eyePosition;
layout(location = 1) flat out vec3 faceNormal;
layout(location = 2) noperspective out vec2 screen;
void main() {
    vec4 eye = modelView * vec4(position, 1.0);
    eyePosition = eye.xyz;
    faceNormal = normal;
    gl_Position = projection * eye;
    screen = gl_Position.xy * 0.01;
}
