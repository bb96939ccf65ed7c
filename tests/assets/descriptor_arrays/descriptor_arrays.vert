ATTRIBUTE(0) vec3 position;
layout(location = 1) in dmat3 turn;
layout(location = 7) in vec4 tint;
void main() { gl_Position = vec4(turn * position, 1.0) + tint; }
