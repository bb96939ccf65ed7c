#version 430 core
in vec3 position;
uniform sampler2D heights;
uniform mat4 toClip;
out vec2 place;

void main() {
    vec3 moved = position;
#ifdef LIFTED
    moved.y += texture(heights, position.xz).r;
#endif
    place = position.xz;
    gl_Position = toClip * vec4(moved, 1.0);
}
