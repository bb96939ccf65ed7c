#version 430 core
layout(vertices = 3) out;
in vec2 place[];
out vec2 corner[];
patch out vec3 weights;

void main() {
    corner[gl_InvocationID] = place[gl_InvocationID];
    weights = vec3(1.0);
    gl_TessLevelOuter[0] = gl_TessLevelOuter[1] = gl_TessLevelOuter[2] = 2.0;
    gl_TessLevelInner[0] = 2.0;
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
}
