#version 450
// An ordinary vertex shader.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 modelView;
uniform mat4 projection;
uniform mat3 normalMatrix;
layout(location = 0) out vec3 eyeNormal;
layout(location = 1) out vec3 eyePosition;

void main() {
    vec4 placed = modelView * vec4(position, 1.0);
    eyeNormal = normalMatrix * normal;
    eyePosition = placed.xyz;
    gl_Position = projection * placed;
}
