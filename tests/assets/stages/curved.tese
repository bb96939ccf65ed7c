#version 430 core
layout(triangles) in;
in vec2 corner[];
patch in vec3 weights;
uniform sampler2D bulges;
out vec2 place;

void main() {
    vec3 at = gl_TessCoord * weights;
    place = corner[0] * at.x + corner[1] * at.y + corner[2] * at.z;
    gl_Position = gl_in[0].gl_Position * at.x + gl_in[1].gl_Position * at.y + gl_in[2].gl_Position * at.z;
    gl_Position.z += texture(bulges, place).r;
}
