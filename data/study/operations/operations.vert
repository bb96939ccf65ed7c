// Places the vertex and hands on where it is.
#include <varyings>

ATTRIBUTE(0) vec3 position;

BLOCK(1, Transform) {
    mat4 modelViewProjection;
} transform;

void main() {
    gl_Position = transform.modelViewProjection * vec4(position, 1.0);
    writeVaryings();
}
