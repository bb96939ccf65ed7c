#version 450 core
layout(location = 0) in vec3 position;

layout(std140) uniform Camera { mat4 view; mat3 normals; vec3 eye; float far; };
layout(std140) uniform Object { mat4 model; mat3 normals; mat3 turn; } object;

out vec3 toEye;

void main() {
    toEye = normals * object.normals * object.turn * (eye - position);
    gl_Position = view * object.model * vec4(position, far);
}
