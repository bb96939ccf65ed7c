#version 330 core
in vec3 position;
#ifdef OPAQUE
in vec3 color;
#else
in vec4 color;
#endif
out vec4 vertexColor;

void main() {
    gl_Position = vec4(position, 1.0);
#ifdef OPAQUE
    vertexColor = vec4(color, 1.0);
#else
    vertexColor = color;
#endif
}
